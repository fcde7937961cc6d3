// Drawing triangles: where fragments are, what attachments do with them.

#include "lab/gpu/commands.h"
#include "lab/gpu/image.h"
#include "lab/scene/error.h"
#include "tests/parity/validated_device.h"

#include <array>

namespace manylights::lab::gpu {
namespace {

constexpr std::uint32_t kVertexCode[] =
#include "gpu_raster.vert.inc"
    ;
constexpr std::uint32_t kColorCode[] =
#include "gpu_raster.frag.inc"
    ;
constexpr std::uint32_t kFragmentsCode[] =
#include "gpu_raster_fragments.frag.inc"
    ;

constexpr std::uint32_t kWidth = 13, kHeight = 7, kPixels = kWidth * kHeight;
constexpr VkFormat kColor = VK_FORMAT_R32G32B32A32_SFLOAT, kDepth = VK_FORMAT_D32_SFLOAT;

using Rectangle = std::array<float, 4>;
using Counts = std::vector<std::uint32_t>;

struct Push {
    float width, height, depth;
};

class GpuRasterTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(validated_device().validation_active()); }
    void TearDown() override { EXPECT_EQ(validated_device().validation_messages(), 0u); }

    static RasterPipeline pipeline(const RasterState& state) {
        RasterShader shader;
        shader.name = "rectangles";
        shader.vertex = kVertexCode;
        if (state.color == VK_FORMAT_UNDEFINED)
            shader.fragment = kFragmentsCode;
        else
            shader.fragment = kColorCode;
        shader.buffer_count = 2;
        shader.push_constant_bytes = sizeof(Push);
        return RasterPipeline(validated_device(), shader, state);
    }

    /// Draws the rectangles, at a depth, and leaves how often each pixel was drawn in counts_.
    void draw(const RasterState& state, const std::vector<Rectangle>& rectangles, const Targets& targets, float depth) {
        const RasterPipeline drawn = pipeline(state);
        const Buffer corners(validated_device(), "rectangles", std::span<const Rectangle>(rectangles));
        const Buffer counts(validated_device(), "counts", kPixels * sizeof(std::uint32_t));
        Commands commands(validated_device());
        commands.fill(counts, 0);
        commands.barrier();
        commands.begin_drawing(targets);
        commands.draw(drawn, {{corners}, {counts}}, Push{float(kWidth), float(kHeight), depth},
                      {6, static_cast<std::uint32_t>(rectangles.size())});
        commands.end_drawing();
        commands.submit_and_wait("rectangles");
        counts_ = counts.download<std::uint32_t>();
    }

    static Image image(VkFormat format, VkImageUsageFlags usage) {
        return Image(validated_device().context(), "drawn",
                     {kWidth, kHeight, format, usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    }

    template <typename T>
    static std::vector<T> pixels(const Image& image) {
        const Buffer buffer(validated_device(), "pixels", kPixels * sizeof(T));
        Commands commands(validated_device());
        commands.copy(image, buffer);
        commands.submit_and_wait("a copy");
        return buffer.download<T>();
    }

    Counts counts_;
};

// As often as rectangles lie over the pixel's centre: triangles share an edge and no pixel.
TEST_F(GpuRasterTest, draws_a_pixel_once_for_each_rectangle_over_its_centre_without_any_image) {
    const std::vector<Rectangle> rectangles{{0, 0, 13, 7}, {2, 1, 9, 5}, {3, 3, 4, 4}, {5.75f, 2.75f, 6.25f, 3.25f}};
    draw({}, rectangles, {kWidth, kHeight}, 0.0f);
    Counts expected(kPixels, 1);
    for (std::uint32_t y = 1; y < 5; ++y)
        for (std::uint32_t x = 2; x < 9; ++x) expected[y * kWidth + x] = 2;
    expected[3 * kWidth + 3] = 3;
    EXPECT_EQ(counts_, expected);
}

TEST_F(GpuRasterTest, draws_only_within_the_area) {
    draw({}, {{-5, -5, 50, 50}}, {4, 3}, 0.0f);
    Counts expected(kPixels, 0);
    // The area's pixels are those of the viewport too, in which the shader's rectangle covers everything.
    for (std::uint32_t y = 0; y < 3; ++y)
        for (std::uint32_t x = 0; x < 4; ++x) expected[y * kWidth + x] = 1;
    EXPECT_EQ(counts_, expected);
}

TEST_F(GpuRasterTest, front_faces_turn_counter_clockwise) {
    const std::vector<Rectangle> front{{0, 0, 13, 7}}, back{{13, 0, 0, 7}};
    const auto is_drawn = [&](const std::vector<Rectangle>& rectangles, VkCullModeFlags cull) {
        RasterState state;
        state.cull = cull;
        draw(state, rectangles, {kWidth, kHeight}, 0.0f);
        return counts_ == Counts(kPixels, 1);
    };
    EXPECT_TRUE(is_drawn(front, VK_CULL_MODE_NONE));
    EXPECT_TRUE(is_drawn(front, VK_CULL_MODE_BACK_BIT));
    EXPECT_FALSE(is_drawn(front, VK_CULL_MODE_FRONT_BIT));
    EXPECT_TRUE(is_drawn(back, VK_CULL_MODE_NONE));
    EXPECT_FALSE(is_drawn(back, VK_CULL_MODE_BACK_BIT));
    EXPECT_TRUE(is_drawn(back, VK_CULL_MODE_FRONT_BIT));
}

// 1 + 2^24 + 2^-24 + 1 + ... as floats: every order has a sum of its own.
TEST_F(GpuRasterTest, adds_colours_in_the_order_of_instances) {
    const Image color = image(kColor, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    RasterState state;
    state.color = kColor;
    state.adds_color = true;
    const std::vector<Rectangle> rectangles(30, Rectangle{0, 0, 13, 7});
    draw(state, rectangles, {kWidth, kHeight, {&color}}, 0.0f);
    float sum = 0.0f;
    for (std::size_t i = 0; i < rectangles.size(); ++i)
        sum += i % 3 == 0 ? 1.0f : i % 3 == 1 ? 16777216.0f : 1.0f / 16777216.0f;
    for (const auto& pixel : pixels<std::array<float, 4>>(color))
        for (const float channel : pixel) EXPECT_EQ(channel, sum);
    draw(state, {{0, 0, 13, 7}}, {kWidth, kHeight, {&color, true}}, 0.0f);
    EXPECT_EQ((pixels<std::array<float, 4>>(color).front()[0]), sum + 1.0f) << "the image was not kept";
    state.adds_color = false;
    draw(state, {{0, 0, 13, 7}}, {kWidth, kHeight, {&color, true}}, 0.0f);
    EXPECT_EQ((pixels<std::array<float, 4>>(color).front()[0]), 1.0f);
}

TEST_F(GpuRasterTest, compares_and_keeps_depths) {
    const Image depth = image(kDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    RasterState state;
    state.depth = kDepth;
    state.depth_passes = VK_COMPARE_OP_GREATER;
    state.writes_depth = true;
    draw(state, {{0, 0, 6, 7}}, {kWidth, kHeight, {}, {&depth}}, 0.5f);
    state.writes_depth = false;
    const auto drawn_at = [&](float at, VkCompareOp passes) {
        state.depth_passes = passes;
        draw(state, {{0, 0, 13, 7}}, {kWidth, kHeight, {}, {&depth, true}}, at);
        return std::pair(counts_[0] == 1, counts_[12] == 1); // where the depth is 0.5, and where it is 0
    };
    EXPECT_EQ(drawn_at(0.25f, VK_COMPARE_OP_GREATER), std::pair(false, true));
    EXPECT_EQ(drawn_at(0.5f, VK_COMPARE_OP_GREATER), std::pair(false, true));
    EXPECT_EQ(drawn_at(0.75f, VK_COMPARE_OP_GREATER), std::pair(true, true));
    EXPECT_EQ(drawn_at(0.5f, VK_COMPARE_OP_LESS_OR_EQUAL), std::pair(true, false));
    EXPECT_EQ(pixels<float>(depth)[0], 0.5f);
    EXPECT_EQ(pixels<float>(depth)[12], 0.0f);
}

TEST_F(GpuRasterTest, clips_depths_out_of_range_or_clamps_them) {
    const Image depth = image(kDepth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    RasterState state;
    state.depth = kDepth;
    state.writes_depth = true;
    for (const bool clamps : {false, true}) {
        state.clamps_depth = clamps;
        draw(state, {{0, 0, 13, 7}}, {kWidth, kHeight, {}, {&depth}}, 1.5f);
        EXPECT_EQ(counts_, Counts(kPixels, clamps ? 1 : 0));
        EXPECT_EQ(pixels<float>(depth)[0], clamps ? 1.0f : 0.0f);
    }
}

TEST_F(GpuRasterTest, names_what_a_pipeline_takes) {
    const RasterPipeline drawn = pipeline({});
    const Buffer one(validated_device(), "one", 16);
    Commands commands(validated_device());
    try {
        commands.draw(drawn, {{one}}, Push{}, {6, 1});
        ADD_FAILURE() << "a buffer is missing";
    } catch (const DeviceError& error) {
        EXPECT_NE(std::string(error.what()).find("'rectangles' takes 2 buffers and 12 bytes"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace manylights::lab::gpu
