/* What Linux has and macOS has not is removed, and the reverse. */
#pragma once
#include_next <sys/socket.h>
#undef MSG_NOSIGNAL
#undef SOCK_CLOEXEC
#define SO_NOSIGPIPE 0x1022
#define setsockopt macos_setsockopt
#ifdef __cplusplus
extern "C"
#endif
int macos_setsockopt(int socket, int level, int name, const void* value, socklen_t size);
