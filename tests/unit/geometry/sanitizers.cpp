// What the leak sanitizer is told to pass over: assimp's loaders forget some bytes when they give up on a damaged file.

#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp.so"; }
#endif
