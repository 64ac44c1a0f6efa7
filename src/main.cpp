#include "shell/run.h"

int main(int argc, char** argv) { return tendril::shell::run(argc, argv); }
