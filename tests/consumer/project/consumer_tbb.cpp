// The adapter for oneTBB, found through its target alone.
#include <manylights/manylights.hpp>
#include <manylights/manylights_tbb.hpp>

int main() {
    ManylightsSettings settings = manylights::make_settings();
    manylights::use_tbb(settings);
    manylights::Builder builder;
    return builder.create(settings) ? 0 : 1;
}
