// What was typed in an interactive session and ran, in a form that runs as a script.
#pragma once

#include <string>
#include <vector>

namespace tendril::lua {

struct Transcript {
  struct Entry {
    std::string typed;   ///< as it stood in the session; "" for what came before the first prompt
    std::string script;  ///< the same in a script: what printed its value is a print(...), locals stay in a block
  };
  std::vector<Entry> entries;

  bool has_lines() const;
  std::string text() const;  ///< the script, with a first line that says what it is
};

/// The first line of such a script begins like this.
inline constexpr const char* transcript_mark = "-- A session of tendril ";

}  // namespace tendril::lua
