#include "shell/run.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "base/error.h"
#include "base/processes.h"
#include "binding/lua_registry.h"
#include "shell/arguments.h"
#include "shell/doctor.h"
#include "shell/history.h"
#include "shell/init_file.h"
#include "shell/limits.h"
#include "shell/module_path.h"
#include "shell/repl.h"
#include "shell/sandbox.h"
#include "shell/script_form.h"

namespace tendril::shell {
namespace {

constexpr int done = 0, failed = 1, misused = 2, interrupted = 130;

/// Lua's memory: what the arguments say, else TENDRIL_MEMORY ("512M", "8G"; "0": no limit), else the usual.
std::size_t lua_memory(const Arguments& arguments) {
  if (arguments.memory) return *arguments.memory;
  if (const char* wanted = arguments.ignore_environment ? nullptr : std::getenv("TENDRIL_MEMORY"))
    return parse_size(wanted, "TENDRIL_MEMORY");
  return usual_memory_limit();
}

/// What the protected part of the program works with.
struct Program {
  Session& session;
  const Arguments& arguments;
  int argc;
  char** argv;
  std::string script_path = {};  ///< of the script's file, where it is one
  int exit_code = done;
};

/// The global `arg`: the script at 0, its arguments from 1, everything before at negative places.
void set_arg_table(lua_State* L, const Program& program) {
  const int script = program.arguments.script;
  lua_createtable(L, std::max(program.argc - script - 1, 0), script + 1);
  for (int i = 0; i < program.argc; ++i) {
    lua_pushstring(L, program.argv[i]);
    lua_rawseti(L, -2, i - script);
  }
  lua_setglobal(L, "arg");
}

void set_module_path(lua_State* L, const Program& program) {
  const bool has_file = program.arguments.script > 0 && !program.arguments.script_is_stdin;
  std::string& folder = lua::context(L).script_folder;
  folder = folder_of(has_file ? program.argv[program.arguments.script] : "");
  const std::string path = module_path(folder, !program.arguments.ignore_environment);
  lua_getglobal(L, "package");
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, "path");
  lua_pop(L, 1);
}

/// Calls what was loaded, with `arguments` values above it; with a load error instead, tells that.
bool finish(Session& session, int load_status, int arguments) {
  if (load_status != LUA_OK) {
    session.tell_error();
    return false;
  }
  return session.call(arguments, 0) && !session.was_interrupted();
}

bool run_step(Session& session, const Step& step) {
  lua_State* L = session.state();
  if (step.kind == Step::Kind::execute)
    return finish(session, luaL_loadbufferx(L, step.text.data(), step.text.size(), "=(command line)", "t"), 0);
  const auto equals = step.text.find('=');
  const std::string module = equals == std::string::npos ? step.text : step.text.substr(equals + 1);
  const std::string name = equals == std::string::npos ? module : step.text.substr(0, equals);
  lua_getglobal(L, "require");
  lua_pushlstring(L, module.data(), module.size());
  if (!session.call(1, 1)) return false;
  lua_setglobal(L, name.c_str());
  return !session.was_interrupted();
}

bool run_script(Program& program) {
  lua_State* L = program.session.state();
  const int script = program.arguments.script;
  const int status = luaL_loadfilex(L, program.script_path.empty() ? nullptr : program.script_path.c_str(), "t");
  const int count = status == LUA_OK && script > 0 ? program.argc - script - 1 : 0;
  luaL_checkstack(L, count + 3, "too many arguments to script");
  for (int i = 0; i < count; ++i) lua_pushstring(L, program.argv[script + 1 + i]);
  return finish(program.session, status, count);
}

void print_version() { std::printf("tendril %s  (%s)\n", TENDRIL_VERSION, LUA_RELEASE); }

/// What ran before the prompt, as a script: the steps of the command line and the script with its arguments.
std::vector<std::string> before_prompt(const Program& program) {
  lua_State* L = program.session.state();
  const auto quoted = [](const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '\n' ? "\\n" : c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return result + "\"";
  };
  std::vector<std::string> lines;
  for (const Step& step : program.arguments.steps) {
    const auto equals = step.text.find('=');
    const std::string module = equals == std::string::npos ? step.text : step.text.substr(equals + 1);
    lines.push_back(step.kind == Step::Kind::execute
                        ? script_form(L, step.text, false)
                        : "_G[" + quoted(step.text.substr(0, equals)) + "] = require(" + quoted(module) + ")");
  }
  const int script = program.arguments.script;
  if (script == 0 || program.arguments.script_is_stdin) return lines;
  std::string given;
  for (int i = script + 1; i < program.argc; ++i) given += (given.empty() ? "" : ", ") + quoted(program.argv[i]);
  lines.push_back("assert(loadfile(" + quoted(program.argv[script]) + "))(" + given + ")");
  return lines;
}

void interact(const Program& program) {
  Session& session = program.session;
  const Terminal& terminal = session.terminal();
  std::vector<std::string> before = before_prompt(program);
  const bool own_settings = !program.arguments.ignore_environment && !program.arguments.sandbox;
  const std::string init = own_settings ? init_path() : "";
  if (run_init_file(session, init)) before.push_back(script_form(session.state(), "dofile [==[" + init + "]==]", false));
  session.begin_transcript(before);
  std::string pending;
  if (!terminal.can_edit()) {
    const auto reader = make_plain_reader();
    return run_repl(session, *reader, pending);
  }
  std::printf("help() says what there is, help(x) or ?x about x; Ctrl-C stops what runs, Ctrl-D leaves.\n");
  const auto reader = make_line_editor(completer_for(session, pending), history_path());
  run_repl(session, *reader, pending);
}

/// In the order and with the conditions of the standalone Lua interpreter.
bool run_all(Program& program) {
  Session& session = program.session;
  const Arguments& a = program.arguments;
  lua_State* L = session.state();
  if (a.warnings) lua_warning(L, "@on", 0);
  if (a.version && (!a.interactive || session.terminal().can_edit())) print_version();
  set_arg_table(L, program);
  if (!a.sandbox) set_module_path(L, program);
  for (const Step& step : a.steps)
    if (!run_step(session, step)) return false;
  if (a.script > 0 && !run_script(program)) return false;
  if (a.interactive) {
    interact(program);
  } else if (a.script == 0 && !a.has_code && !a.version) {
    if (!session.terminal().input) return run_script(program);
    if (session.terminal().can_edit()) print_version();
    interact(program);
  }
  return true;
}

int protected_program(lua_State* L) {
  Program& program = *static_cast<Program*>(lua_touserdata(L, 1));
  lua_settop(L, 0);
  const bool good = run_all(program);
  program.exit_code = good ? done : time_is_over() ? out_of_time : program.session.was_interrupted() ? interrupted : failed;
  return 0;
}

int run_doctor(const Terminal& terminal) {
  const std::vector<Finding> findings = examine(terminal);
  std::fputs(report_text(findings).c_str(), stdout);
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.broken; }) ? failed : done;
}

int run_session(int argc, char** argv, const Arguments& given) {
  Arguments arguments = given;
  if (arguments.sandbox) {
    if (!arguments.memory) arguments.memory = sandbox_memory;
    if (!arguments.seconds) arguments.seconds = sandbox_seconds;
  }
  if (arguments.memory) limit_memory(*arguments.memory);
  const Terminal terminal = look_at_terminal();
  if (arguments.sandbox && terminal.input && arguments.script == 0 && !arguments.has_code)
    throw UsageError("'--sandbox' needs a script");
  Session session(terminal, lua_memory(arguments));
  if (arguments.seconds) limit_time(*arguments.seconds);
  lua_State* L = session.state();
  if (arguments.mode == Arguments::Mode::annotations) {
    std::fputs(lua::annotations(*lua::context(L).registry).c_str(), stdout);
    return done;
  }
  Program program{session, arguments, argc, argv};
  const bool has_file = arguments.script > 0 && !arguments.script_is_stdin;
  if (has_file) program.script_path = argv[arguments.script];
  if (arguments.sandbox) program.script_path = enter_sandbox(L, *arguments.sandbox, program.script_path);
  lua_pushcfunction(L, protected_program);
  lua_pushlightuserdata(L, &program);
  if (lua_pcall(L, 1, 0, 0) != LUA_OK) {
    session.tell_error();
    return failed;
  }
  return program.exit_code;
}

}  // namespace

int run(int argc, char** argv) {
  // All of several processes run the script, one prints.
  if (!is_first_process() && !std::freopen("/dev/null", "w", stdout)) return failed;
  const Terminal terminal = look_at_terminal();
  try {
    const Arguments arguments = parse_arguments(argc, argv);
    int code = done;
    if (arguments.mode == Arguments::Mode::help) std::fputs(usage().c_str(), stdout);
    else if (arguments.mode == Arguments::Mode::version_only) print_version();
    else if (arguments.mode == Arguments::Mode::doctor) code = run_doctor(terminal);
    else code = run_session(argc, argv, arguments);
    if (std::fflush(stdout) != 0 && code == done) {
      tell(terminal, "cannot write to standard output");
      code = failed;
    }
    return code;
  } catch (const UsageError& error) {
    tell(terminal, error.what());
    std::fputs("'tendril --help' lists the options.\n", stderr);
    return misused;
  } catch (const std::bad_alloc&) {
    tell(terminal, "not enough memory");
    return failed;
  }
}

}  // namespace tendril::shell
