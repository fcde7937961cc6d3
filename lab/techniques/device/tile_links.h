#pragma once
// Lists of lights as links, one behind the other, from a pool of all lists: no pass to count them, and another load for
// each light when they are walked. A pool that was too small is made as large as was needed, and the pass repeated.

#include "lab/techniques/device/fitted_buffer.h"
#include "lab/techniques/device/tile_pass.h"

namespace manylights::lab {

class TileLinks {
  public:
    /// shader: its text includes tile_links.glsl; its own buffers are from binding 4 on.
    TileLinks(gpu::Device& device, const TilePassShader& shader);

    /// Builds them and waits; the device's time in milliseconds. buffers: the technique's own. Throws InputError where
    /// there are more links than 32 bits number.
    double build(const TilePassInput& input, const std::vector<gpu::Binding>& buffers, std::uint32_t lists);

    /// A word each: the list's first link.
    const gpu::Buffer& heads() const { return heads_.buffer(); }
    /// LightLink each (light_link.glsl), as many as the pool has room for.
    const gpu::Buffer& links() const { return links_.buffer(); }
    std::uint64_t link_count() const { return link_count_; }
    /// Of heads and links that are in use.
    std::uint64_t bytes() const;

  private:
    double link(const TilePassInput& input, const std::vector<gpu::Binding>& buffers);
    void reserve(std::uint64_t links);

    gpu::Device& device_;
    std::string name_;
    TilePass pass_;
    FittedBuffer heads_, links_, taken_;
    std::uint64_t capacity_ = 0, link_count_ = 0;
};

} // namespace manylights::lab
