/* What macOS adds to <fcntl.h>, <stdio.h> and <unistd.h>: the compiler reads this file first. */
#pragma once
#define F_FULLFSYNC 51
#define RENAME_EXCL 0x00000004
#define SYNC_VOLUME_FULLSYNC 0x01
#define SYNC_VOLUME_WAIT 0x02
#ifdef __cplusplus
extern "C" {
#endif
int renamex_np(const char* from, const char* to, unsigned int flags);
int fsync_volume_np(int file, int flags);
#ifdef __cplusplus
}
#endif
