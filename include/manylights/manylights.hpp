// manylights for C++20: the C interface of manylights.h with RAII, std::span and statuses that must be looked at.
// Nothing of its own; manylights.h is the manual.
#ifndef MANYLIGHTS_MANYLIGHTS_HPP
#define MANYLIGHTS_MANYLIGHTS_HPP

#include <manylights/manylights.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace manylights {

// What a call came to, and why. True where it succeeded.
struct [[nodiscard]] Status {
    ManylightsReport report{MANYLIGHTS_OK, "", "", 0};

    explicit operator bool() const noexcept { return report.status == MANYLIGHTS_OK; }
    const char* name() const noexcept { return manylights_status_name(report.status); }
};

// A length as the C interface takes it. One that does not fit becomes 2^32 - 1, which every call refuses.
constexpr std::uint32_t to_count(std::size_t size) noexcept {
    return size < UINT32_MAX ? static_cast<std::uint32_t>(size) : UINT32_MAX;
}

// Structs of the C interface with their size filled in.
inline ManylightsSettings make_settings() noexcept {
    ManylightsSettings settings{};
    settings.size = sizeof(settings);
    return settings;
}

inline ManylightsView make_view() noexcept {
    ManylightsView view{};
    view.size = sizeof(view);
    view.guard_px = 0.5f;
    return view;
}

inline ManylightsLights make_lights(std::span<const ManylightsSphere> spheres) noexcept {
    ManylightsLights lights{};
    lights.size = sizeof(lights);
    lights.spheres = spheres.data();
    lights.count = to_count(spheres.size());
    return lights;
}

// Owns a ManylightsBuilder. Empty until create, and after it was moved from; calls on an empty one fail with a status.
class Builder {
  public:
    Builder() = default;
    Builder(const Builder&) = delete;
    Builder& operator=(const Builder&) = delete;
    Builder(Builder&& other) noexcept : builder_(std::exchange(other.builder_, nullptr)) {}
    Builder& operator=(Builder&& other) noexcept {
        std::swap(builder_, other.builder_);
        return *this;
    }
    ~Builder() { manylights_destroy(builder_); }

    // Replaces what this holds, also where it fails.
    Status create(const ManylightsSettings& settings = make_settings()) noexcept {
        manylights_destroy(std::exchange(builder_, nullptr));
        Status status;
        manylights_create(&settings, &builder_, &status.report);
        return status;
    }

    Status plan(std::span<const ManylightsView> views, const ManylightsLights& lights,
                ManylightsSizes& sizes) noexcept {
        Status status;
        manylights_plan(builder_, views.data(), to_count(views.size()), &lights, &sizes, &status.report);
        return status;
    }

    Status write(const ManylightsBuffers& buffers) noexcept {
        Status status;
        manylights_write(builder_, &buffers, &status.report);
        return status;
    }

    Status visible(std::uint32_t view, std::span<const std::uint32_t>& indices) const noexcept {
        Status status;
        const std::uint32_t* first = nullptr;
        std::uint32_t count = 0;
        manylights_visible(builder_, view, &first, &count, &status.report);
        indices = {first, count};
        return status;
    }

    ManylightsStats stats() const noexcept {
        ManylightsStats stats{};
        manylights_stats(builder_, &stats);
        return stats;
    }

    Status validate(const ManylightsBuffers& buffers, const ManylightsSizes& sizes,
                    std::uint32_t light_count) noexcept {
        Status status;
        manylights_validate(builder_, &buffers, &sizes, light_count, &status.report);
        return status;
    }

    explicit operator bool() const noexcept { return builder_ != nullptr; }
    ManylightsBuilder* get() const noexcept { return builder_; }

  private:
    ManylightsBuilder* builder_ = nullptr;
};

} // namespace manylights

#endif
