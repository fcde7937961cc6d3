#pragma once
// What the suite `build` times: the paper's pipeline, the library's structures, and the floor of the machine.

#include <manylights/manylights.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace manylights::lab::suites {

struct BuildFrame {
    ManylightsView view;
    std::vector<ManylightsSphere> spheres;

    ManylightsLights lights() const;
};

/// What a build made; zero where there is no such thing.
struct BuildCounts {
    std::uint32_t tile_px = 0;
    std::uint64_t tiles = 0, visible_lights = 0, references = 0, bytes = 0;
};

/// What a builder is.
struct BuilderChoice {
    std::string_view name;   ///< of a structure, or "paper hybrid", "floor"
    std::uint32_t structure; ///< a ManylightsStructure; 0 where it is none of the library's
    std::uint32_t tile_px;   ///< 0: as the library chooses
    std::uint32_t threads;
};

/// All memory is kept between builds, as a renderer keeps it.
class Contender {
  public:
    virtual ~Contender() = default;
    virtual void build(const BuildFrame& frame) = 0;
    virtual BuildCounts counts() const = 0; ///< of the last build
};

/// O'Donnell and Chajdas' hybrid, tiles of 48 pixels, 16 slices, leaves of 4.
std::unique_ptr<Contender> make_paper_contender();

/// With threads > 1 its work runs on an arena of oneTBB of so many.
std::unique_ptr<Contender> make_library_contender(const BuilderChoice& choice);

/// What no builder of these references can spare: each light is read once, each reference is written once as 8 bytes,
/// and scattered once to its tile. Where a reference goes is a hash of its number: lights, too, are in no order.
std::unique_ptr<Contender> make_floor_contender(const BuildCounts& of);

/// Whether there is something to run two threads on.
bool has_threads();

} // namespace manylights::lab::suites
