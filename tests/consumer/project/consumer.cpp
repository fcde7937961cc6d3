// The C++ wrapper and the shader text, found through the target alone.
#include <manylights/format.h>
#include <manylights/manylights.hpp>

int main() {
    manylights::Builder builder;
    if (!builder.create()) return 1;
    ManylightsSizes sizes{};
    const manylights::Status status = builder.plan({}, manylights::make_lights({}), sizes);
    return status.report.status == MANYLIGHTS_INVALID_ARGUMENT && sizeof(manylights::MlView) == 64 ? 0 : 1;
}
