// The interactive session: reads a statement, runs it, prints what it gives.
#pragma once

#include <string>

#include "shell/line_reader.h"
#include "shell/session.h"

namespace tendril::shell {

/// Until the end of the input. Errors are told and the session goes on.
void run_repl(Session& session, LineReader& reader, std::string& pending);

/// The statements typed so far, which completion has to know: `pending` of run_repl.
Completer completer_for(Session& session, const std::string& pending);

/// Prints the values from `first` to the top of the stack and removes them.
void print_results(Session& session, int first);

}  // namespace tendril::shell
