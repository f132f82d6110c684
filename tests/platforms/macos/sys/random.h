/* macOS declares getentropy() here, Linux in <unistd.h>. */
#pragma once
#include <unistd.h>
