// What lights are tested against for all samples of a cluster.
#ifndef MANYLIGHTS_LAB_CLUSTER_GLSL
#define MANYLIGHTS_LAB_CLUSTER_GLSL

#include "lab/techniques/clustered_samples/hierarchy.glsl"

// In the camera's axes. 48 bytes.
struct Cluster {
    Box box;
    vec4 cone; // middle of the normals; w: the least cosine between it and one of them. -1: any normal
};

// May the sphere's centre be in front of a sample? With v the centre as seen from the middle of the box and rho the box's
// half diagonal, no sample sees it farther along its normal n than n.v + rho; and n.v is |v| where v is in the cone, else
// |v| cos(angle - cone's angle). Numbers that are none keep the light.
//
// Slack: what sphere_slack says of the centre, and 1e-5 of v and of rho, which is more than 20 times what the products
// are off by, here and where the rule decides N.L > 0.
bool may_be_in_front(vec4 sphere, Cluster cluster) {
    if (cluster.cone.w <= -1.0 || is_everywhere(sphere)) return true;
    float rho = 0.5 * length(cluster.box.high.xyz - cluster.box.low.xyz);
    if (!(rho < 1e17)) return true;
    vec3 v = sphere.xyz - 0.5 * (cluster.box.low.xyz + cluster.box.high.xyz);
    float along = dot(v, cluster.cone.xyz);
    float across = length(v - along * cluster.cone.xyz);
    float sine = sqrt(max(1.0 - cluster.cone.w * cluster.cone.w, 0.0));
    float reach = along >= length(v) * cluster.cone.w ? length(v) : along * cluster.cone.w + across * sine;
    return !(reach + rho + sphere_slack(sphere) + 1e-5 * (length(v) + rho) <= 0.0);
}

#endif
