// Where the stones' sites begin: at random, one for each stone's worth of area.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/pavement/fields.h"
#include "tessera/voronoi/site.h"

namespace tessera::pavement {

// h as the parameter says, or from the number of stones where that is given (Eq. 1 solved for h); source pixels.
double half_side_of(cv::Size source, const Params& params);
// n of Eq. 1.
int sites_for(cv::Size source, double half_side);

// Sows the first sites of a drawing that comes row after row.
class Sower {
 public:
  // Lengths in pixels of the diagram.
  Sower(cv::Size picture, double half_side, const Params& params, std::uint64_t seed);

  // Sows blocks of rows from next_row() on until `end` is reached or passed. `fields` are of whole rows, those and
  // 3 h on both sides of them; positions are in pixels of the whole picture.
  void sow(const Fields& fields, int end, Sites& sites);
  int next_row() const { return next_row_; }
  int block() const { return block_; }  // rows that are sown together

 private:
  // Collects pixels of one zone until they hold a stone; any of them, weighted by density, may be its site.
  struct Stratum {
    double filled = 0;
    double next = 0;  // fill at which the site is placed
    bool placed = false;
  };
  void visit(const Fields& fields, cv::Point p, Sites& sites);

  cv::Size picture_;
  double half_side_;
  const Params& params_;
  Rng positions_, shapes_;
  double plain_;  // stones a pixel far from edges
  int block_, next_row_ = 0;
  std::array<Stratum, 256> strata_;
  std::vector<cv::Point> order_;  // of the pixels of a block
};

// All of them at once: sites in their zones; thin zones get as many as stones of their own width need. Positions are
// random within strata of one stone's area each, so that no hole of several stones is left for the iterations to
// fill.
Sites first_sites(const Fields& fields, const Params& params, std::uint64_t seed);

}  // namespace tessera::pavement
