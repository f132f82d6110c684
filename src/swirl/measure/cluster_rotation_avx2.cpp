// The kernel of cluster_rotation.hpp for AVX2. Empty if the compiler does not use it.
#if defined(__AVX2__)
#define SWIRL_ROTATION_KERNEL
#include "swirl/measure/cluster_rotation_kernel.hpp"
#endif
