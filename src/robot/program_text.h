// What the dialects' readers and writers share.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "robot/program.h"

namespace tendril::program {

/// A path in the controller's own angles, with the times and shares that its moves need.
struct Moves {
  std::string name;
  JointPath shown;              ///< rad
  std::vector<double> seconds;  ///< of the move to each point; the first: 0
  double speed;                 ///< share
  double zone;                  ///< m
  std::vector<double> radius;   ///< m, of each point: the zone, or half the shorter way beside it; 0: stop
  std::vector<double> share;    ///< the same as a share of half the shorter way
};

std::string write_rapid(const Moves& moves);
std::string write_krl(const Moves& moves);
std::string write_urscript(const Moves& moves);
std::string write_ls(const Moves& moves);
std::string write_csv(const Robot& robot, const Moves& moves);

/// In the controller's own angles, rad.
struct Source {
  std::string_view text;
  const std::string& name;
  int joints;
  [[noreturn]] void fail(std::size_t offset, const std::string& why) const;  ///< "program 'name:line': why"
};
JointPath read_rapid(const Source& source);
JointPath read_krl(const Source& source);
JointPath read_urscript(const Source& source);
JointPath read_ls(const Source& source);
JointPath read_csv(const Source& source, const Robot& robot, bool degrees);

/// With that many digits after the point; never -0.
std::string fixed(double value, int digits);
/// "a,b,c" of angles, in degrees or rad.
std::string angle_list(const std::vector<double>& angles, bool degrees, int digits, const char* between = ",");

/// A stretch of the text without comments and without what stands in its strings, and where it begins.
struct Statement {
  std::string text;
  std::size_t offset;
  std::vector<std::array<std::size_t, 2>> lines =
      {};  ///< of one that was joined: where each line begins in `text`, and in the source
  std::size_t offset_of(std::size_t place) const;  ///< in the source, of a place in `text`
};
/// Lines without what follows `comment` outside of strings, trimmed; empty ones are left out.
std::vector<Statement> lines_of(const Source& source, std::string_view comment);
/// Lines joined up to each `;`.
std::vector<Statement> statements_of(const Source& source, std::string_view comment);

std::string lowered(std::string_view text);
std::string trimmed(std::string_view text);
bool begins_with_word(std::string_view lowered_text, std::string_view word);
/// Numbers between `,` in `text`, which stands at `offset`. `d2r(x)` of URScript is understood.
std::vector<double> number_list(const Source& source, std::string_view text, std::size_t offset);
double number(const Source& source, std::string_view text, std::size_t offset);

}  // namespace tendril::program
