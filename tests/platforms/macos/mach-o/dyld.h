/* Declarations as in macOS: see macos.c. */
#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C"
#endif
int _NSGetExecutablePath(char* buffer, uint32_t* size);
