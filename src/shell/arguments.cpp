#include "shell/arguments.h"

#include <cstring>

#include "base/error.h"
#include "base/nearest_name.h"
#include "shell/limits.h"

namespace tendril::shell {
namespace {

UsageError unknown(const std::string& option) {
  static const std::vector<std::string> known = {"--help",   "--version", "--annotations", "--sandbox", "--memory",
                                                 "--seconds", "-e", "-i", "-l", "-v", "-h", "-E", "-W"};
  const std::string near = option.starts_with("--") ? nearest_name(option, known) : "";
  return UsageError("unrecognized option '" + option + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

/// The long options and -h end the reading: nothing after them counts.
bool read_long(const std::string& option, Arguments& arguments) {
  if (option == "--help" || option == "-h") arguments.mode = Arguments::Mode::help;
  else if (option == "--version") arguments.mode = Arguments::Mode::version_only;
  else if (option == "--annotations") arguments.mode = Arguments::Mode::annotations;
  else return false;
  return true;
}

/// --sandbox[=FOLDER], --memory SIZE, --seconds NUMBER; the latter two may have a = too. Moves `i` to the last argument used.
bool read_limit(int argc, const char* const* argv, int& i, Arguments& arguments) {
  const std::string option = argv[i];
  const std::string name = option.substr(0, option.find('='));
  if (name != "--sandbox" && name != "--memory" && name != "--seconds") return false;
  std::optional<std::string> value;
  if (name.size() < option.size()) value = option.substr(name.size() + 1);
  if (name == "--sandbox") {
    if (value && value->empty()) throw UsageError("'--sandbox=' needs a folder");
    arguments.sandbox = value.value_or("");
    return true;
  }
  if (!value && i + 1 >= argc) throw UsageError("'" + name + "' needs argument");
  if (!value) value = argv[++i];
  if (name == "--memory") arguments.memory = parse_size(*value, name);
  else arguments.seconds = parse_seconds(*value, name);
  return true;
}

constexpr std::size_t least_memory = 64ull << 20;  // below it the program itself does not fit

/// Strangers' scripts run alone: nobody talks to them.
void check_limits(const Arguments& arguments) {
  if (arguments.memory && *arguments.memory < least_memory) throw UsageError("'--memory' is less than the 64M that the program needs");
  if (arguments.sandbox && arguments.interactive) throw UsageError("'--sandbox' runs a script: it does not go with -i");
}

/// -e and -l: their text is the rest of the argument or the next argument. Moves `i` to the last one used.
Step read_step(int argc, const char* const* argv, int& i) {
  const Step::Kind kind = argv[i][1] == 'e' ? Step::Kind::execute : Step::Kind::require;
  if (argv[i][2] != '\0') return {kind, argv[i] + 2};
  const std::string option = argv[i];
  if (i + 1 >= argc || argv[i + 1][0] == '-') throw UsageError("'" + option + "' needs argument");
  return {kind, argv[++i]};
}

}  // namespace

Arguments parse_arguments(int argc, const char* const* argv) {
  Arguments a;
  if (argc > 1 && std::strcmp(argv[1], "doctor") == 0) {
    if (argc > 2) throw UsageError("'tendril doctor' takes nothing more; a script of that name runs as ./doctor");
    a.mode = Arguments::Mode::doctor;
    return a;
  }
  int i = 1;
  for (; i < argc && argv[i][0] == '-'; ++i) {
    const std::string option = argv[i];
    if (option == "--") {
      ++i;
      break;
    }
    if (option == "-") {
      a.script_is_stdin = true;
      break;
    }
    if (read_long(option, a)) return a;
    if (read_limit(argc, argv, i, a)) continue;
    const bool alone = option.size() == 2;
    switch (option[1]) {
      case 'E': if (!alone) throw unknown(option); a.ignore_environment = true; break;
      case 'W': if (!alone) throw unknown(option); a.warnings = true; break;
      case 'i': if (!alone) throw unknown(option); a.interactive = a.version = true; break;
      case 'v': if (!alone) throw unknown(option); a.version = true; break;
      case 'e': a.has_code = true; [[fallthrough]];
      case 'l': a.steps.push_back(read_step(argc, argv, i)); break;
      default: throw unknown(option);
    }
  }
  a.script = i < argc ? i : 0;
  check_limits(a);
  return a;
}

std::string usage() {
  return "usage: tendril [options] [script [args]]\n"
         "       tendril doctor  say what is there on this machine and what is missing (a script of that name: ./doctor)\n"
         "  -e code         run `code`\n"
         "  -i              enter interactive mode after running `script`\n"
         "  -l mod          require module `mod` into global `mod`\n"
         "  -l name=mod     require module `mod` into global `name`\n"
         "  -v              show the version\n"
         "  -E              ignore environment variables\n"
         "  -W              turn warnings on\n"
         "  --              stop handling options\n"
         "  -               stop handling options and run standard input\n"
         "  --sandbox [=FOLDER]  run a stranger's script: files only below FOLDER (default: the script's folder), no io, os,\n"
         "                  debug, compiled code or programs; at most 512M of memory and 60 s\n"
         "  --memory SIZE   memory that the program may take, such as 512M or 8G\n"
         "  --seconds N     seconds that it may take; then it ends with 124\n"
         "  -h, --help      show this text and leave\n"
         "  --version       show the version and leave\n"
         "  --annotations   print editor annotations of every function and leave\n"
         "Without arguments: an interactive session, or the script on standard input when that is no terminal.\n"
         "Exit codes: 0 done, 1 error in the script, 2 wrong usage, 124 out of time, 130 interrupted.\n"
         "Environment: TENDRIL_LUA folders searched for modules, TENDRIL_MEMORY limit of Lua's memory (8G), NO_COLOR;\n"
         "  TENDRIL_MODULES, TENDRIL_ASSETS, TENDRIL_FONTS other folders of what comes with the program; TENDRIL_BATCH its inner\n"
         "  loop (common, avx2, avx512); TENDRIL_PICTURES how the terminal shows pictures (kitty, iterm, sixel, none).\n"
         "  Interactive sessions run ~/.config/tendril/init.lua first, but not with -E. More: man tendril.\n";
}

}  // namespace tendril::shell
