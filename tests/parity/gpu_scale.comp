#version 450
// target[i] = source[i] * factor, for sizes that are no multiple of the workgroup.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint factor = 1u;
layout(constant_id = 1) const uint summand = 0u;
layout(set = 0, binding = 0) readonly buffer Source { uint d[]; } source;
layout(set = 0, binding = 1) writeonly buffer Target { uint d[]; } target;
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < count) target.d[i] = source.d[i] * factor + summand;
}
