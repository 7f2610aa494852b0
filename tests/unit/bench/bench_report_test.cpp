// What the benchmark writes can be read again; runs side by side; files that are something else are refused.
#include "bench/bench_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace tarn {
namespace {

const std::vector<BenchFigure> old_figures{{{"rays", "terrain-128", "primary", "tarn"}, "Mrays/s", {4, 6, 5}},
                                           {{"sim", "terrain-128", "tick", "awake"}, "ms", {0.1, 0.3}}};

std::string line_with(const std::string& text, const std::string& part) {
    const std::size_t at = text.find(part);
    if (at == std::string::npos) return "";
    const std::size_t begin = text.rfind('\n', at) + 1;
    return text.substr(begin, text.find('\n', at) - begin);
}

std::string refusal(const std::string& text) {
    try {
        read_bench_json(text, "old.json");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(BenchReport, JsonHoldsEverySampleAndReadsBack) {
    const std::string text = bench_json({.about = {{"cpu", "a \"quoted\" name"}},
                                         .settings_json = "{\"quality\": \"balanced\"}",
                                         .figures = old_figures,
                                         .notes = {"a note"},
                                         .failures = {}});
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json["about"]["cpu"], "a \"quoted\" name");
    EXPECT_EQ(json["settings"]["quality"], "balanced");
    EXPECT_EQ(json["notes"][0], "a note");
    EXPECT_EQ(json["figures"][0]["median"], 5);
    const std::vector<BenchFigure> back = read_bench_json(text, "back");
    ASSERT_EQ(back.size(), old_figures.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
        EXPECT_EQ(back[i].key, old_figures[i].key);
        EXPECT_EQ(back[i].unit, old_figures[i].unit);
        EXPECT_EQ(back[i].samples, old_figures[i].samples);
    }
}

TEST(BenchReport, CsvHasOneRowAFigure) {
    EXPECT_EQ(bench_csv(old_figures),
              "suite,scene,what,who,unit,median,min,max,spread,samples\n"
              "rays,terrain-128,\"primary\",tarn,Mrays/s,5,4,6,0.2,3\n"
              "sim,terrain-128,\"tick\",awake,ms,0.2,0.1,0.3,0.5,2\n");
}

TEST(BenchReport, ComparesWhatBothRunsHold) {
    const std::vector<BenchFigure> now{{{"rays", "terrain-128", "primary", "tarn"}, "Mrays/s", {10, 10, 11}},
                                       {{"sim", "terrain-128", "tick", "awake"}, "ms", {0.25, 0.35}},
                                       {{"sim", "terrain-256", "tick", "awake"}, "ms", {1}}};
    const std::string text = compare_text(old_figures, now);
    EXPECT_TRUE(line_with(text, "primary").ends_with("2.000  better")) << text;
    EXPECT_TRUE(line_with(text, "tick").ends_with("1.500  ")) << text;  // the samples overlap
    EXPECT_NE(text.find("2 figures in both, 0 only in the old, 1 only in the new run"), std::string::npos)
        << text;
    const std::vector<BenchFigure> slow{{{"sim", "terrain-128", "tick", "awake"}, "ms", {0.4, 0.4}}};
    EXPECT_TRUE(line_with(compare_text(old_figures, slow), "tick").ends_with("2.000  worse"));
    EXPECT_EQ(compare_text(old_figures, {}), "no figure is in both runs\n");
}

TEST(BenchReport, ComparesTheBarsOfBothRuns) {
    const auto run = [](double tarn, double embree) {
        return std::vector<BenchFigure>{
            {{"rays", "terrain-128", "primary", "tarn"}, "Mrays/s", {tarn}},
            {{"rays", "terrain-128", "primary", "embree-8"}, "Mrays/s", {embree}}};
    };
    // Half the speed of both: a busy machine, no loss.
    const std::string busy = line_with(compare_text(run(6, 12), run(3, 6)), "Embree's packets");
    EXPECT_TRUE(busy.ends_with("0.5       0.5    1.000")) << busy;
    const std::string gain = line_with(compare_text(run(6, 12), run(9, 12)), "Embree's packets");
    EXPECT_TRUE(gain.ends_with("0.5      0.75    1.500")) << gain;
    EXPECT_EQ(compare_text(old_figures, old_figures).find("bar:"),
              std::string::npos);  // neither holds Embree
}

TEST(BenchReport, RefusesOtherFiles) {
    EXPECT_NE(refusal("{}").find("old.json: not a bench.json"), std::string::npos) << refusal("{}");
    EXPECT_NE(refusal("not json").find("old.json"), std::string::npos);
    EXPECT_NE(refusal(R"({"tarn_bench": 2, "figures": []})").find("reads 1"), std::string::npos);
    EXPECT_NE(refusal(R"({"tarn_bench": 1, "figures": [{"suite": "rays"}]})").find("old.json"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"tarn_bench": 1, "figures": [{"suite": "a", "scene": "b", "what": "c", "who": "d",
                          "unit": "ms", "samples": []}]})")
                  .find("without samples"),
              std::string::npos);
}

}  // namespace
}  // namespace tarn
