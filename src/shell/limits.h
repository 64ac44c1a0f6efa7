// How much memory and time the program may take.
#pragma once

#include <cstddef>
#include <string>

namespace tendril::shell {

/// "512M", "8G", "1e6": bytes. Throws UsageError "who: ..." for anything else.
std::size_t parse_size(const std::string& text, const std::string& who);

/// "60", "0.5": seconds, more than 0. Throws UsageError "who: ..." for anything else.
double parse_seconds(const std::string& text, const std::string& who);

/// What Lua's values may take without a word from the user, bytes: 8 GiB, but at most three quarters of the machine's.
std::size_t usual_memory_limit();

/// From now on the whole program has this much memory (bytes) for its data. What asks for more fails; where nothing can deal
/// with that, the program ends with a message and exit code 1.
void limit_memory(std::size_t bytes);

/// From now on the program has so many seconds. Then what runs is interrupted as by Ctrl-C, and two seconds later the program
/// ends wherever it is: no hook of Lua's fires within its library's own functions or within finalisers.
void limit_time(double seconds);

/// The time is over; and what is said then: "the time limit of 60 s is reached".
bool time_is_over();
const char* time_limit_text();

inline constexpr int out_of_time = 124;  ///< exit code, as that of timeout(1)

}  // namespace tendril::shell
