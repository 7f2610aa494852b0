// Readers of the log of changes find every change once, whenever they look.
#include "passes/changes.h"

#include <vector>

#include "gpu/gl_test.h"

namespace tarn {
namespace {

using ChangesTest = GlTest;

constexpr glm::ivec3 size_bricks{7, 5, 3};
constexpr std::uint32_t bricks = 105;

// A log and two readers of it; what the bricks are is of no matter.
class Logged {
  public:
    explicit Logged(std::uint32_t written)
        : log_(size_bricks, written),
          append_({.label = "log changes", .compute = "tests/kernels/log_changes.comp"}),
          count_({.label = "count changes", .compute = "tests/kernels/count_changes.comp"}) {}

    void append(std::uint32_t first, std::uint32_t count) {
        ++version;
        log_.bind();
        append_.set("first", first);
        append_.set("count", count);
        append_.dispatch({2, 1, 1});
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    // How often each brick is new to the reader.
    std::vector<std::uint32_t> read(ChangeReader& reader) const {
        gl::Buffer seen("seen", bricks * sizeof(std::uint32_t));
        seen.bind_storage(0);
        reader.read(log_, version);
        reader.run(count_, log_);
        std::vector<std::uint32_t> counts(bricks);
        seen.download(std::span(counts));
        return counts;
    }
    ChangeLog& log() { return log_; }

    std::uint32_t version = 0;

  private:
    ChangeLog log_;
    gl::Program append_, count_;
};

std::vector<std::uint32_t> once(std::uint32_t first, std::uint32_t count) {
    std::vector<std::uint32_t> counts(bricks, 0);
    std::fill_n(counts.begin() + first, count, 1u);
    return counts;
}

std::vector<std::uint32_t> sum(std::vector<std::uint32_t> a, const std::vector<std::uint32_t>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
    return a;
}

// Also where the count of entries wraps.
TEST_F(ChangesTest, readers_find_what_changed_since_they_looked_last) {
    for (const std::uint32_t written : {0u, 1000u, 0u - 1u, 0u - 40u, 0u - 150u}) {
        SCOPED_TRACE(written);
        Logged logged(written);
        ChangeReader often;
        ChangeReader seldom;
        EXPECT_EQ(logged.read(often), once(0, bricks)) << "all are new in the first";
        EXPECT_EQ(logged.read(often), once(0, 0));
        EXPECT_EQ(logged.read(seldom), once(0, bricks));
        logged.append(3, 30);
        EXPECT_EQ(logged.read(often), once(3, 30));
        EXPECT_EQ(often.last_change(), 1u);
        logged.append(20, 70);
        EXPECT_EQ(logged.read(often), once(20, 70));
        EXPECT_EQ(logged.read(often), once(0, 0));
        EXPECT_EQ(logged.read(seldom), sum(once(3, 30), once(20, 70)));
        ++logged.version;
        EXPECT_EQ(logged.read(often), once(0, 0));
        EXPECT_EQ(often.last_change(), 2u) << "nothing changed since";
        // As many as the log holds, then one more.
        for (const std::uint32_t more : {0u, 1u}) {
            logged.append(0, bricks);
            logged.append(0, logged.log().capacity() - bricks + more);
            const auto all = sum(once(0, bricks), once(0, logged.log().capacity() - bricks));
            EXPECT_EQ(logged.read(seldom), more == 0 ? all : once(0, bricks));
        }
    }
}

TEST_F(ChangesTest, all_are_new_again_where_a_reader_cannot_know) {
    Logged logged(0);
    ChangeReader reader;
    EXPECT_EQ(logged.read(reader), once(0, bricks));
    logged.log().add_all();
    ++logged.version;
    EXPECT_EQ(logged.read(reader), once(0, bricks)) << "a world was loaded";
    reader.restart();
    EXPECT_EQ(logged.read(reader), once(0, bricks));
    // So many versions that the count of changes may have come round.
    logged.version += (1u << 31) / logged.log().capacity() - 1;
    EXPECT_EQ(logged.read(reader), once(0, 0));
    logged.version += (1u << 31) / logged.log().capacity();
    EXPECT_EQ(logged.read(reader), once(0, bricks));
}

}  // namespace
}  // namespace tarn
