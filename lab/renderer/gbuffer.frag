#version 460
// The shading normal on the side that the camera sees, and the material. Files are not always oriented, so the side is
// that of the triangle itself: a smooth normal near a silhouette may lean away from the camera and is right all the same.
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in uint material_id;
layout(location = 0) out uvec4 normal_and_material;

bool is_usable(vec3 v) {
    float squared_length = dot(v, v);
    return squared_length > 1e-30 && squared_length < 1e30;
}

void main() {
    vec3 to_camera = is_usable(point) ? -normalize(point) : vec3(0.0, 1.0, 0.0);
    vec3 face = cross(dFdx(point), dFdy(point));
    face = is_usable(face) ? normalize(face) : to_camera;
    if (dot(face, to_camera) < 0.0) face = -face;
    vec3 shading = is_usable(normal) ? normalize(normal) : face;
    if (dot(shading, face) < 0.0) shading = -shading;
    normal_and_material = uvec4(floatBitsToUint(shading), material_id);
}
