#include "lab/gpu/commands.h"

#include "lab/gpu/held.h"
#include "lab/gpu/image.h"

#include <algorithm>

namespace manylights::lab::gpu {

namespace {

constexpr std::uint32_t kMaxTimestamps = 64;
constexpr std::uint32_t kSetsPerPool = 32;

// Of images between one drawing and the next, whichever attachments they are.
constexpr vk::ImageLayout kDrawnLayout = vk::ImageLayout::eGeneral;

vk::raii::CommandPool make_pool(Context& context) {
    return vk::raii::CommandPool(
        context.vk(), vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, context.queue_family));
}

vk::raii::CommandBuffer make_command_buffer(Context& context, vk::CommandPool pool) {
    const vk::CommandBufferAllocateInfo info(pool, vk::CommandBufferLevel::ePrimary, 1);
    return std::move(vk::raii::CommandBuffers(context.vk(), info).front());
}

vk::raii::QueryPool make_query_pool(Context& context) {
    return vk::raii::QueryPool(context.vk(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, kMaxTimestamps));
}

} // namespace

struct Commands::State {
    std::shared_ptr<Context> context;
    vk::raii::CommandPool pool;
    vk::raii::CommandBuffer buffer;
    std::vector<vk::raii::DescriptorPool> descriptor_pools;
    std::uint32_t sets_left = 0, bindings_left = 0; // of the last descriptor pool
    vk::raii::QueryPool queries;
    vk::raii::Fence fence;
    std::uint32_t timestamps = 0;
    std::vector<std::uint64_t> ticks;

    explicit State(std::shared_ptr<Context> shared)
        : context(std::move(shared)), pool(make_pool(*context)), buffer(make_command_buffer(*context, *pool)),
          queries(make_query_pool(*context)), fence(context->vk(), vk::FenceCreateInfo()) {
        buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
        buffer.resetQueryPool(*queries, 0, kMaxTimestamps);
    }

    vk::DescriptorSet make_set(vk::DescriptorSetLayout layout, std::uint32_t binding_count);
    template <typename Pipeline>
    void bind(const Pipeline& pipeline, const std::vector<Binding>& buffers, std::span<const std::byte> push_constants);
    void change_layout(const Image& image, vk::ImageLayout from, vk::ImageLayout to);
    void memory_barrier(vk::PipelineStageFlags2 stages, vk::AccessFlags2 access);
    void wait(const char* what, double limit_seconds);
};

vk::DescriptorSet Commands::State::make_set(vk::DescriptorSetLayout layout, std::uint32_t binding_count) {
    if (sets_left == 0 || bindings_left < binding_count) {
        bindings_left = std::max(kSetsPerPool * 8, binding_count);
        sets_left = kSetsPerPool;
        const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, bindings_left);
        descriptor_pools.emplace_back(context->vk(), vk::DescriptorPoolCreateInfo({}, sets_left, size));
    }
    sets_left -= 1;
    bindings_left -= binding_count;
    // Plain handles: the sets go with their pool.
    const vk::DescriptorSetAllocateInfo info(*descriptor_pools.back(), layout);
    const vk::Device device = *context->vk();
    return device.allocateDescriptorSets(info, *context->vk().getDispatcher()).front();
}

namespace {

struct PipelineKind {
    vk::PipelineBindPoint point;
    vk::ShaderStageFlags stages;
};

PipelineKind kind_of(const ComputePipeline&) {
    return {vk::PipelineBindPoint::eCompute, vk::ShaderStageFlagBits::eCompute};
}

PipelineKind kind_of(const RasterPipeline&) {
    return {vk::PipelineBindPoint::eGraphics, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment};
}

} // namespace

template <typename Pipeline>
void Commands::State::bind(const Pipeline& pipeline, const std::vector<Binding>& buffers,
                           std::span<const std::byte> push_constants) {
    if (buffers.size() != pipeline.buffer_count() || push_constants.size() != pipeline.push_constant_bytes())
        throw DeviceError("pipeline '" + pipeline.name() + "' takes " + std::to_string(pipeline.buffer_count()) +
                          " buffers and " + std::to_string(pipeline.push_constant_bytes()) + " bytes, not " +
                          std::to_string(buffers.size()) + " and " + std::to_string(push_constants.size()));
    const PipelineKind kind = kind_of(pipeline);
    buffer.bindPipeline(kind.point, pipeline.handle());
    if (!buffers.empty()) {
        const vk::DescriptorSet set = make_set(pipeline.set_layout(), pipeline.buffer_count());
        std::vector<vk::DescriptorBufferInfo> infos;
        for (const Binding& binding : buffers)
            infos.emplace_back(binding.buffer.handle(), binding.offset,
                               binding.bytes == 0 ? VK_WHOLE_SIZE : binding.bytes);
        std::vector<vk::WriteDescriptorSet> writes;
        for (std::uint32_t i = 0; i < infos.size(); ++i)
            writes.emplace_back(set, i, 0u, 1u, vk::DescriptorType::eStorageBuffer, nullptr, &infos[i]);
        context->vk().updateDescriptorSets(writes, nullptr);
        buffer.bindDescriptorSets(kind.point, pipeline.layout(), 0, set, nullptr);
    }
    if (!push_constants.empty()) buffer.pushConstants<std::byte>(pipeline.layout(), kind.stages, 0, push_constants);
}

// After everything so far, and before everything that follows.
void Commands::State::change_layout(const Image& image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageSubresourceRange whole(vk::ImageAspectFlags(image.aspect()), 0, 1, 0, 1);
    const vk::ImageMemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                          vk::PipelineStageFlagBits2::eAllCommands,
                                          vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, from,
                                          to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.handle(), whole);
    vk::DependencyInfo dependency;
    dependency.setImageMemoryBarriers(barrier);
    buffer.pipelineBarrier2(dependency);
}

void Commands::State::memory_barrier(vk::PipelineStageFlags2 stages, vk::AccessFlags2 access) {
    const vk::MemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                     stages, access);
    vk::DependencyInfo dependency;
    dependency.setMemoryBarriers(barrier);
    buffer.pipelineBarrier2(dependency);
}

void Commands::State::wait(const char* what, double limit_seconds) {
    const auto limit = static_cast<std::uint64_t>(limit_seconds * 1e9);
    if (context->vk().waitForFences(*fence, VK_TRUE, limit) == vk::Result::eSuccess) return;
    context->hung = true;
    throw DeviceError("the device " + context->info.name + " did not finish " + what + " within " +
                      std::to_string(limit_seconds) + " s");
}

Commands::Commands(Device& device) : Commands(device.context()) {}

Commands::Commands(std::shared_ptr<Context> context) {
    if (context->hung) throw DeviceError("the device " + context->info.name + " has not finished its earlier work");
    asking_for(*context, "preparing commands", [&] {
        state_ = std::shared_ptr<State>(new State(context), [](State* state) {
            if (!state->context->hung) delete state;
        });
    });
}

Commands::~Commands() = default;

void Commands::dispatch(const ComputePipeline& pipeline, const std::vector<Binding>& buffers,
                        std::span<const std::byte> push_constants, const std::array<std::uint32_t, 3>& groups) {
    const DeviceInfo& info = state_->context->info;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (groups[axis] > info.max_workgroups[axis])
            throw DeviceError("pipeline '" + pipeline.name() + "': " + std::to_string(groups[axis]) +
                              " workgroups on an axis, and the device " + info.name + " allows " +
                              std::to_string(info.max_workgroups[axis]));
    asking_for(*state_->context, "recording '" + pipeline.name() + "'", [&] {
        state_->bind(pipeline, buffers, push_constants);
        state_->buffer.dispatch(groups[0], groups[1], groups[2]);
    });
}

namespace {

vk::RenderingAttachmentInfo attachment_of(const Target& target) {
    vk::RenderingAttachmentInfo info;
    if (target.image == nullptr) return info;
    info.setImageView(target.image->view()).setImageLayout(kDrawnLayout);
    info.setLoadOp(target.keeps ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear);
    info.setStoreOp(vk::AttachmentStoreOp::eStore);
    return info;
}

} // namespace

void Commands::begin_drawing(const Targets& targets) {
    const vk::raii::CommandBuffer& command = state_->buffer;
    for (const Target& target : {targets.color, targets.depth})
        if (target.image != nullptr && !target.keeps)
            state_->change_layout(*target.image, vk::ImageLayout::eUndefined, kDrawnLayout);
    const vk::RenderingAttachmentInfo color = attachment_of(targets.color), depth = attachment_of(targets.depth);
    const vk::Rect2D area({0, 0}, {targets.width, targets.height});
    vk::RenderingInfo info;
    info.setRenderArea(area).setLayerCount(1);
    if (targets.color.image != nullptr) info.setColorAttachments(color);
    if (targets.depth.image != nullptr) info.setPDepthAttachment(&depth);
    command.beginRendering(info);
    command.setViewport(0, vk::Viewport(0.0f, 0.0f, float(targets.width), float(targets.height), 0.0f, 1.0f));
    command.setScissor(0, area);
}

void Commands::end_drawing() { state_->buffer.endRendering(); }

void Commands::draw(const RasterPipeline& pipeline, const std::vector<Binding>& buffers,
                    std::span<const std::byte> push_constants, const VertexRange& range) {
    asking_for(*state_->context, "recording '" + pipeline.name() + "'", [&] {
        state_->bind(pipeline, buffers, push_constants);
        state_->buffer.draw(range.vertices, range.instances, 0, 0);
    });
}

void Commands::draw(const RasterPipeline& pipeline, const Mesh& mesh, std::span<const std::byte> push_constants) {
    asking_for(*state_->context, "recording '" + pipeline.name() + "'", [&] {
        state_->bind(pipeline, {}, push_constants);
        state_->buffer.bindVertexBuffers(0, vk::Buffer(mesh.vertices.handle()), vk::DeviceSize(0));
        state_->buffer.bindIndexBuffer(mesh.indices.handle(), 0, vk::IndexType::eUint32);
        state_->buffer.drawIndexed(mesh.index_count, 1, 0, 0, 0);
    });
}

void Commands::barrier() {
    state_->memory_barrier(vk::PipelineStageFlagBits2::eAllCommands,
                           vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite);
}

void Commands::copy(const Buffer& source, const Buffer& target, std::uint64_t bytes, std::uint64_t source_offset,
                    std::uint64_t target_offset) {
    if (bytes == 0) return;
    state_->buffer.copyBuffer(source.handle(), target.handle(), vk::BufferCopy(source_offset, target_offset, bytes));
}

void Commands::copy(const Image& source, const Buffer& target) {
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlags(source.aspect()), 0, 0, 1}, {0, 0, 0},
                                     {source.width(), source.height(), 1});
    state_->change_layout(source, kDrawnLayout, vk::ImageLayout::eTransferSrcOptimal);
    state_->buffer.copyImageToBuffer(source.handle(), vk::ImageLayout::eTransferSrcOptimal, target.handle(), region);
    state_->change_layout(source, vk::ImageLayout::eTransferSrcOptimal, kDrawnLayout);
}

void Commands::fill(const Buffer& target, std::uint32_t word) {
    const std::uint64_t bytes = target.bytes() / 4 * 4;
    if (bytes > 0) state_->buffer.fillBuffer(target.handle(), 0, bytes, word);
}

std::uint32_t Commands::timestamp() {
    if (state_->context->timestamp_bits == 0 || state_->timestamps == kMaxTimestamps)
        throw DeviceError("the device " + state_->context->info.name + " has no further time stamp");
    state_->buffer.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *state_->queries, state_->timestamps);
    return state_->timestamps++;
}

void Commands::submit_and_wait(const char* what, double limit_seconds) {
    asking_for(*state_->context, what, [&] {
        state_->memory_barrier(vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
        state_->buffer.end();
        const vk::CommandBufferSubmitInfo command(*state_->buffer);
        vk::SubmitInfo2 submit;
        submit.setCommandBufferInfos(command);
        state_->context->queue->submit2(submit, *state_->fence);
        state_->wait(what, limit_seconds);
        if (state_->timestamps == 0) return;
        const std::size_t bytes = state_->timestamps * sizeof(std::uint64_t);
        const auto [result, ticks] = state_->queries.getResults<std::uint64_t>(
            0, state_->timestamps, bytes, sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
        if (result == vk::Result::eSuccess) state_->ticks = ticks;
    });
}

double Commands::milliseconds(std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t bits = state_->context->timestamp_bits;
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << bits) - 1;
    return double((state_->ticks.at(to) - state_->ticks.at(from)) & mask) * state_->context->timestamp_ns * 1e-6;
}

VkCommandBuffer Commands::handle() const { return *state_->buffer; }

} // namespace manylights::lab::gpu
