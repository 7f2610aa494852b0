// `tarn doctor`: what the driver offers against what Tarn needs, and a self-test.
#pragma once

namespace tarn {

// Prints a line per check. 0: all good; 1: a check failed. No driver at all is a failed check.
int run_doctor();

}  // namespace tarn
