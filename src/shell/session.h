// One Lua session: the state with everything of tendril in it, how code is run in it and how its errors are told.
#pragma once

#include <string>

#include "binding/lua_context.h"
#include "binding/shell_services.h"
#include "binding/transcript.h"
#include "shell/interrupts.h"
#include "shell/picture_query.h"
#include "shell/progress.h"
#include "shell/terminal.h"

namespace tendril::shell {

class Session {
 public:
  /// `memory_limit` in bytes. Throws std::bad_alloc when not even an empty state fits.
  Session(const Terminal& terminal, std::size_t memory_limit);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  lua_State* state() { return L_; }
  const Terminal& terminal() const { return terminal_; }

  /// Calls the function below `arguments` values on the stack; its results stay. On an error: tells it, leaves nothing and
  /// returns false. With an interrupt pending that is what is told.
  bool call(int arguments, int results);

  /// Tells the error on top of the stack on standard error and removes it.
  void tell_error();

  bool was_interrupted() const { return was_interrupted_; }

  /// From now on what runs at the prompt is kept, for session.save; `before`: as a script, what ran already.
  void begin_transcript(const std::vector<std::string>& before);

  /// After an interrupt: the session can go on.
  void resume_after_interrupt();

 private:
  void tell_interrupt();

  Terminal terminal_;
  lua::Context context_;
  lua::Transcript transcript_;
  PictureQuery pictures_;
  lua::ShellServices services_;
  Interrupts interrupts_;
  Progress progress_;
  lua_State* L_ = nullptr;
  bool was_interrupted_ = false;
};

/// "tendril: " and the message on standard error, after everything printed so far.
void tell(const Terminal& terminal, const std::string& message);

}  // namespace tendril::shell
