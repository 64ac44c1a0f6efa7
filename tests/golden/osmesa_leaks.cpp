// The leak checker's list for programs that draw: OSMesa keeps one small framebuffer per process, which is not ours to free.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
