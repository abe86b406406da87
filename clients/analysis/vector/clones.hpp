// Compiles a function for each kind of vector unit, of which the processor's is chosen when the program starts. All of
// them compute the same bits, because the compiler does not contract floating-point operations.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define LOCKSTEP_VECTOR_CLONES [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#else
#define LOCKSTEP_VECTOR_CLONES
#endif
