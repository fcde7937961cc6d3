#pragma once
// What `verify` holds the techniques to: the right light sets of every point, and a radiance and an image of them.

#include "lab/app/progress.h"
#include "lab/app/workbench.h"

namespace manylights::lab::app {

/// Brute force is the truth up to so many tests of a light at a pixel: about half a minute on two processors.
constexpr std::uint64_t kMostTests = std::uint64_t{1} << 33;

struct Truth {
    std::string name;                    ///< in a line that says what differs from it
    std::string description;             ///< how it was found, in a line or two
    std::string failure;                 ///< why it is none, and nothing is judged; empty: it is one
    std::vector<std::string> techniques; ///< those to judge, in the order asked for
    /// Whose radiance counts: that needs a device, and is compared within one only. Prepared.
    std::unique_ptr<Technique> shader;
    std::vector<PixelRecord> shaded; ///< what it recorded
    std::vector<PixelRecord> records;
    std::vector<float> radiance;
    std::vector<std::uint8_t> mask;
};

/// Throws InputError where --remove-one-light asks for a light that is not there.
Truth find_truth(Workbench& bench, const VerifyArguments& arguments, Progress& progress);

} // namespace manylights::lab::app
