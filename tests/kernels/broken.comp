// Does not compile: line 8 calls what does not exist (program_test.cpp).
#include "shared/hash.h"

layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Result { uint result; };

void main() {
    result = no_such_function(hash1(1u));
}
