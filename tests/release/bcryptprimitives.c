/* For Wine 8, which lacks the one function that Rust's library takes of this library of Windows. A part of the check
   alone: nobody is given it. */
#include <stddef.h>

int __stdcall SystemFunction036(void *bytes, unsigned long count);

__declspec(dllexport) int __stdcall ProcessPrng(unsigned char *bytes, size_t count) {
    return SystemFunction036(bytes, (unsigned long)count);
}
