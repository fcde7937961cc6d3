#pragma once
// The lights that affect a point, found without asking all of them: the truth where brute force would take too long.
//
// One hashed grid per octave of the range, so that a few large lights do not fill the cells of many small ones. A light
// is filed in every cell that its box touches; a point asks the lights of its cell in each grid, and ml_affects
// decides.

#include "reference/oracle/cell_table.h"
#include "reference/oracle/light_set.h"

namespace manylights::oracle {

class LightGrid {
  public:
    explicit LightGrid(const std::vector<RelativeLight>& lights);

    /// Appends the indices of the lights that affect the point, ascending: those of affecting_lights (light_set.h). May
    /// be called from several threads at once.
    void append_affecting(MlFloat3 point, std::vector<std::uint32_t>& indices) const;

  private:
    /// The lights of one octave.
    class Level {
      public:
        Level(int edge_exponent, std::vector<RelativeLight> lights);
        void append_affecting(MlFloat3 point, std::vector<std::uint32_t>& indices) const;

      private:
        /// Cells from that of one corner to that of the other.
        struct Box {
            CellPosition first, last;
            int cell_count() const { return (last.x - first.x + 1) * (last.y - first.y + 1) * (last.z - first.z + 1); }
        };
        Box box_of(const RelativeLight& light) const;
        std::vector<std::uint32_t> add_cells();
        void file(const std::vector<std::uint32_t>& cells);

        double inverse_edge_; ///< a power of two
        std::vector<RelativeLight> lights_;
        CellTable cells_;
        std::vector<std::uint64_t> first_;   ///< per cell, and one behind the last: its filings
        std::vector<std::uint32_t> filings_; ///< positions in lights_
    };

    std::vector<Level> levels_;
};

} // namespace manylights::oracle
