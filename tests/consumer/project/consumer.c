/* The public header is C. */
#include <manylights/manylights.h>

#include <stdio.h>

int main(void) {
    ManylightsSettings settings = {0};
    ManylightsBuilder* builder = NULL;
    ManylightsReport report;
    settings.size = sizeof(settings);
    if (manylights_create(&settings, &builder, &report) != MANYLIGHTS_OK) {
        printf("%s %s\n", report.field, report.rule);
        return 1;
    }
    manylights_destroy(builder);
    return 0;
}
