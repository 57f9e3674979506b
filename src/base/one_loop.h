#pragma once

/// Before a function whose whole body, calls and all, is to become one loop in lanes. Not under sanitizers: their checks of every inlined
/// operation would take the compiler many minutes.
#if defined(__SANITIZE_ADDRESS__)
#define GONIO_ONE_LOOP
#else
#define GONIO_ONE_LOOP [[gnu::flatten]]
#endif
