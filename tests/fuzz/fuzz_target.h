// What every fuzz target is made of. A target is one function that takes bytes of any kind; it judges what the reader did with
// them and ends the program where that is wrong, so that both libFuzzer and the replay of the corpus (replay.cpp) see it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace tendril::fuzz {

/// What the target promises.
inline void expect(bool holds, const std::string& promise) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", promise.c_str());
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Runs a reader: false when it refuses its input, which it may only do with a UsageError that begins with `who`. Every other
/// exception passes and ends the program.
template <class Read>
bool accepts(const std::string& who, Read read) {
  try {
    read();
    return true;
  } catch (const UsageError& refused) {
    const std::string why = refused.what();
    expect(why.rfind(who, 0) == 0 && why.size() > who.size() + 4, "the message '" + why + "' begins with '" + who + "' and gives a reason");
    return false;
  }
}

}  // namespace tendril::fuzz
