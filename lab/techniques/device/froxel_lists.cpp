#include "lab/techniques/device/froxel_lists.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kListsRecord[] =
#include "froxel_lists_record.comp.inc"
    ;
constexpr std::uint32_t kListsShade[] =
#include "froxel_lists_shade.comp.inc"
    ;
constexpr std::uint32_t kListsLog[] =
#include "froxel_lists_log.comp.inc"
    ;
constexpr std::uint32_t kLinksRecord[] =
#include "froxel_links_record.comp.inc"
    ;
constexpr std::uint32_t kLinksShade[] =
#include "froxel_links_shade.comp.inc"
    ;
constexpr std::uint32_t kLinksLog[] =
#include "froxel_links_log.comp.inc"
    ;

constexpr std::uint32_t kBuffers = 3;

} // namespace

PassShaders froxel_list_shaders(const std::string& name) {
    return {name, kListsRecord, kListsShade, kListsLog, kBuffers};
}

PassShaders froxel_link_shaders(const std::string& name) {
    return {name, kLinksRecord, kLinksShade, kLinksLog, kBuffers};
}

} // namespace manylights::lab
