// From a pixel and the rasteriser's depth to the point that is shaded: the one place where this is computed.
#ifndef MANYLIGHTS_LAB_POINT_GLSL
#define MANYLIGHTS_LAB_POINT_GLSL

// The camera's axes in world space, and in w what goes with each.
struct CameraAxes {
    vec4 position; // world space; w: near plane
    vec4 right;    // w: half the image's extent at depth 1
    vec4 up;       // likewise
    vec4 forward;
};

// xyz: relative to the camera's position along the world's axes; w: view depth. Zero where nothing was drawn, or where
// it is so far away that a float cannot hold it.
//
// The depth buffer holds near / depth (reversed, far plane at infinity). Centre of pixel x: (x + 0.5) / width of the
// image's extent, from -1 on the left to +1 on the right; row 0 is at the top, where `up` is positive.
vec4 point_of_pixel(CameraAxes camera, uvec2 pixel, uvec2 size, float stored_depth) {
    precise float depth = camera.position.w / stored_depth;
    if (!(stored_depth > 0.0) || !(depth < 1e18)) return vec4(0.0);
    precise float x = ((2.0 * float(pixel.x) + 1.0) / float(size.x) - 1.0) * camera.right.w;
    precise float y = (1.0 - (2.0 * float(pixel.y) + 1.0) / float(size.y)) * camera.up.w;
    precise vec3 ray = camera.right.xyz * x + camera.up.xyz * y + camera.forward.xyz;
    precise vec3 point = ray * depth;
    return vec4(point, depth);
}

#endif
