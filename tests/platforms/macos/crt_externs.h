/* Declarations as in macOS: see macos.c. */
#pragma once
#ifdef __cplusplus
extern "C"
#endif
char*** _NSGetEnviron(void);
