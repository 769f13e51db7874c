// What Buffon's needles tell of a picture (section 5): a needle of length d is thrown, and what its two ends hit is
// compared.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/base/rng.h"
#include "tessera/base/run_context.h"
#include "tessera/image/image_view.h"
#include "tessera/statistics/classes.h"

namespace tessera::statistics {

constexpr int kGreyBins = 8;         // of the co-occurrence
constexpr int kDifferenceBins = 33;  // from -256 to 256, an odd number: 0 lies in a middle

// Of one length.
struct NeedleStatistics {
  double distance = 0;  // px
  std::int64_t needles = 0;
  double same_cell = 0;        // W(d), the chance that both ends lie in one cell, from how often their classes agree
  double same_cell_error = 0;  // what the number of needles alone makes uncertain
  double variogram = 0;        // V(d): mean square of the difference of colours, summed over red, green and blue
  double autocorrelation = 0;  // rho(d), of grey levels
  std::vector<double> transitions;                            // P_ij(d), row after row: given i, the chance of j
  std::array<double, std::size_t{kGreyBins} * kGreyBins> co_occurrence{};  // chance of the two grey levels
  std::array<double, kDifferenceBins> difference{};           // D: chance of that difference of grey levels
};

// `needles` of each length, with both ends in the picture, their directions uniform. Lengths are below the shorter
// side of the picture. Stops when `context` says so, with what it has.
std::vector<NeedleStatistics> throw_needles(const ImageView& picture, const Classes& classes,
                                            const std::vector<double>& distances, int needles, Rng& rng,
                                            const RunContext& context);

// W(d) of cells whose numbers the pixels are.
std::vector<double> same_cell(const cv::Mat1i& cells, const std::vector<double>& distances, int needles, Rng& rng);

// The chance that two pixels so far apart have one label, of all pairs with both in the picture; 1 where there are
// none.
double agreement(const cv::Mat1b& labels, cv::Point offset);

// Mean length of a class's runs along rows and columns that do not touch the border, px; 0 where there are none.
std::vector<double> patch_widths(const Classes& classes);

// Changes of class along rows and columns, a pixel.
double boundary_crossings(const Classes& classes);

// Shares of the classes.
std::vector<double> shares_of(const Classes& classes);

// The chance that two independent things have one class of those shares.
double agreement_by_chance(const std::vector<double>& shares);

}  // namespace tessera::statistics
