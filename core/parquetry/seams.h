// Where pieces that overlap are cut, so that the picture gains most (3.4, a-posteriori refinement).
//
// A seam runs along each line of the grid, from one border of the target to the other, and where two seams cross,
// four pieces meet. From one row of pixels to the next a seam goes straight on or one pixel aside (6-connected), so
// that a column seam and a row seam cross once.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "tessera/parquetry/patches.h"

namespace tessera::parquetry {

// A number for each row of pixels (or column, for seams along the rows): the first pixel behind the seam.
using Seam = std::vector<int>;

// The target's borders are among them: columns[0] and columns[grid.across()]. Pixel (x, y) is in column c of the grid
// where columns[c][y] <= x < columns[c + 1][y], in row r where rows[r][x] <= y < rows[r + 1][x].
struct Seams {
  std::vector<Seam> columns, rows;
};
Seams straight_seams(const Grid& grid);

// What the pieces of wood show of a target.
struct Reconstruction {
  struct Piece {
    cv::Rect box;      // of the patch, grown
    cv::Mat features;  // of the wood there, 8 bits; empty where there is no wood
    cv::Mat1b free;    // 255: pixels that it may have, those of its patch always; empty: all

    bool may_have(int x, int y) const { return free.empty() || free(y - box.y, x - box.x) != 0; }
  };
  Grid grid;
  cv::Mat target;             // features
  std::vector<Piece> pieces;  // of the cells, row by row

  const Piece& piece(int column, int row) const { return pieces[row * grid.across() + column]; }
  // A term of Eq. 8: squared differences of the features at a pixel in the piece's box; 0 without wood.
  std::int64_t error(const Piece& piece, int x, int y) const;
};

// Eq. 8, the features of each pixel those of the piece that it belongs to.
std::int64_t cost_of(const Reconstruction& reconstruction, const Seams& seams);

// Eq. 9: `left` and `right` are the errors of two pieces at `overlap` pixels side by side; costs[x] becomes what it
// costs to have the left one in the first x of them: overlap + 1 numbers.
void cut_costs(const std::int64_t* left, const std::int64_t* right, int overlap, std::int64_t* costs);

// Costs of all places of a cut, `width` of them a row; kNever where it may not be. It may not step from a place to
// that on the left or right below it where `barred` says so.
struct CutCosts {
  static constexpr std::int64_t kNever = std::int64_t{1} << 60;
  enum Step : std::uint8_t { kLeft = 1, kRight = 2 };

  int width = 0;
  std::vector<std::int64_t> costs;
  std::vector<std::uint8_t> barred;  // of the same size, Steps or'ed; empty: none is
};

// The place of the cheapest cut in each row, by dynamic programming; of equal ones that with straight steps, from the
// end on, and the end nearest to the middle. There is one.
std::vector<int> cheapest_cut(const CutCosts& given);

// Where seams may not be, so that pieces can be made; px.
struct SeamLimits {
  int stray = 0;           // from their lines of the grid
  double at_crossing = 0;  // the same where another line crosses; from there on they may open by 20 degrees, so
                           // that pieces have no horns
  double apart = 0;        // nearer to each other than that, no two step aside in the same direction
};

// Optimal for every seam as long as those across it stay; these are found by turns, twice (the paper's two
// repetitions). Seams beside pieces without wood are straight, and no piece gets pixels that it may not have.
Seams find_seams(const Reconstruction& reconstruction, const SeamLimits& limits);

}  // namespace tessera::parquetry
