#include "binding/show_picture.h"

#include <chrono>
#include <cstdio>

#include "binding/lua_context.h"
#include "binding/shell_services.h"

namespace tendril::lua {

ShownPicture show_picture(lua_State* L, const char* instead,
                          const std::function<std::string(const PictureTerminal& terminal, Status& status)>& draw) {
  const auto start = std::chrono::steady_clock::now();
  const Context& c = context(L);
  const ShellServices& shell = shell_services(L);
  const PictureTerminal terminal = shell.picture_terminal ? shell.picture_terminal() : PictureTerminal{};
  ShownPicture shown;
  const auto done = [&](Status status, std::string message) {
    shown.status = status;
    shown.message = std::move(message);
    shown.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return shown;
  };
  if (terminal.protocol == PictureProtocol::none)
    return done(Status::infeasible, (terminal.why.empty() ? "there is no terminal that shows pictures" : terminal.why) + "; " + instead);
  const std::string png = draw(terminal, shown.status);
  if (shown.status != Status::solved) return done(shown.status, std::string(name_of(shown.status)) + ": nothing was drawn");
  const std::string bytes = inline_picture(png, terminal);
  if (c.computation_ended) c.computation_ended();  // the line of progress makes room
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  if (std::fflush(stdout) != 0) return done(Status::stalled, "standard output takes no more");
  shown.by = name_of(terminal.protocol);
  return done(Status::solved, "shown");
}

}  // namespace tendril::lua
