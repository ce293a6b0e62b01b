#pragma once

// Marks a function that works on every block: all its calls are inlined. Not under sanitizers: with
// all their checks in one function the compiler does not finish. Not for Clang, which only checks
// the code here.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
#define TRC_FLATTEN
#else
#define TRC_FLATTEN [[gnu::flatten]]
#endif
