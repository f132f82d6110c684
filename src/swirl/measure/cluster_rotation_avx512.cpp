// The kernel of cluster_rotation.hpp for AVX-512. Empty where the compiler was not told to use it.
#if defined(__AVX512F__)
#define SWIRL_ROTATION_KERNEL
#include "swirl/measure/cluster_rotation_kernel.hpp"
#endif
