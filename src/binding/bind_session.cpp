// session: the lines of the interactive shell.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include "base/error.h"
#include "base/write_file.h"
#include "binding/lua_class.h"
#include "binding/open.h"
#include "binding/saved_file.h"
#include "binding/shell_services.h"
#include "binding/transcript.h"

namespace tendril::lua {

bool Transcript::has_lines() const {
  return std::any_of(entries.begin(), entries.end(), [](const Entry& entry) { return !entry.typed.empty(); });
}

std::string Transcript::text() const {
  std::string text = transcript_mark + std::string(TENDRIL_VERSION) + ", without the lines that failed\n";
  for (const Entry& entry : entries) text += entry.script + "\n";
  return text;
}

namespace {

std::vector<std::string> lines(lua_State* L) {
  std::vector<std::string> typed;
  if (const Transcript* transcript = shell_services(L).transcript)
    for (const Transcript::Entry& entry : transcript->entries)
      if (!entry.typed.empty()) typed.push_back(entry.typed);
  return typed;
}

/// A file that must not be lost: one that no session wrote.
bool is_of_others(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) && !read_file(path).starts_with(transcript_mark);
}

SavedFile save(lua_State* L, const std::string& path, const Options& o) {
  const Transcript* transcript = shell_services(L).transcript;
  if (!transcript) throw UsageError("session.save: this is a script; only the interactive shell keeps its lines");
  if (!transcript->has_lines()) throw UsageError("session.save: nothing has run in this session yet");
  if (!o.get<bool>("overwrite") && is_of_others(path))
    throw UsageError("session.save: '" + path + "' exists and is no saved session; choose another name or say {overwrite = true}");
  const auto start = std::chrono::steady_clock::now();
  write_file(path, transcript->text());
  return {path, Status::solved, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace

void bind_session(lua_State* L) {
  Module(L, "session", "The lines of the interactive shell, to go on as a script")
      .function("lines", {.does = "What was typed and ran, without queries of help; empty in a script.",
                          .example = "for i, line in ipairs(session.lines()) do print(i, line) end"},
                lines)
      .function("save",
                {.takes = {"path"},
                 .options = Schema{option<bool>("overwrite", "", "Also a file that is no saved session").preset(false)},
                 .does = "Writes the session as a script: what failed or asked for help is left out, values that were shown are printed.",
                 .example = "if #session.lines() > 0 then session.save(\"study.lua\") end  -- in a script there are none"},
                save);
}

}  // namespace tendril::lua
