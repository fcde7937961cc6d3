// The one translation unit that holds tinygltf's code.

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
