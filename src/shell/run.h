// The whole program.
#pragma once

namespace tendril::shell {

/// Returns the exit code: 0 done, 1 an error in a script, 2 wrong usage, 130 interrupted.
int run(int argc, char** argv);

}  // namespace tendril::shell
