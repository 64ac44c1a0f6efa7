// Designs that are not solved: alternatives side by side in a picture, or one of them with its clearance.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/preform/options.h"
#include "method/route/options.h"
#include "view/picture.h"

namespace tendril {

/// A centre line to be drawn as a tube, and what the card says of it.
struct PictureDesign {
  std::string name;              ///< "1"
  std::vector<Vec3> points;      ///< m
  double radius = 0;             ///< m
  std::vector<double> gaps;      ///< mm, by point; what colours it. Empty: a colour of its own
  std::vector<PictureCard::Row> rows;
  std::optional<PictureLabel> gap;  ///< where it is nearest to something
};

/// All hoses of a set, each with one row; or one of them (`only`, from 0) coloured by its clearance.
std::vector<PictureDesign> designs_of(const preform::Result& result, std::optional<int> only);

/// The nominal routes of a set.
std::vector<PictureDesign> designs_of(const route::Result& result);

/// What the gaps of such designs mean: the clearance, where all obstacles ask for the same, else the margin to what each asks for.
ColourScale gap_scale(const preform::Result& result);

/// Tubes, labels and card rows. Several designs get categorical colours and their names beside them, where they are farthest from
/// each other.
void add_designs(const std::vector<PictureDesign>& designs, Picture& picture);

}  // namespace tendril
