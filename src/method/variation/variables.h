// The variables of a study, resolved: what each component does to the problem, and how it is drawn.
#pragma once

#include <span>
#include <vector>

#include "method/variation/copula.h"
#include "method/variation/options.h"
#include "method/variation/outcomes.h"
#include "method/variation/spreads.h"
#include "scene/scene_equilibrium.h"

namespace tendril::variation {

class Variables {
 public:
  /// Throws UsageError as Study does.
  Variables(const SceneEquilibrium& nominal, const Options& options);

  const std::vector<Column>& columns() const { return columns_; }
  /// One random number a column; those of tables are not used.
  int dimensions() const { return static_cast<int>(columns_.size()); }

  /// The values of one outcome from numbers in (0, 1), one a column.
  void draw(int outcome, std::span<const double> u, std::span<double> values) const;

  /// Moves a copy of the nominal problem of one system by a share (0 ... 1) of the way to the values.
  void apply(int system, std::span<const double> values, double share, SystemProblem& problem) const;

  /// True when something of the system varies.
  bool reaches(int system) const;

  /// What contributes: a variable, or the variables of one group, and which columns that are.
  struct Contributor {
    std::string name;
    std::vector<int> columns;
    bool drawn = true;  ///< false: from a table
  };
  const std::vector<Contributor>& contributors() const { return contributors_; }

  /// Covariance of the columns.
  Eigen::MatrixXd covariance() const;

 private:
  /// A frame of the problem, by number.
  struct Place {
    int system = 0;
    Parameter::Kind kind = Parameter::Kind::hold_position;
    int rod = 0, index = 0, section = 0;
    bool position = false, orientation = false;
  };
  /// Some columns of one variable.
  struct Piece {
    enum class Kind {
      number,        ///< a parameter of the problem
      shift,         ///< of a frame along one axis
      ball,          ///< of a frame: three columns
      cone,          ///< tilt about d1 and d2: two columns
      twist,         ///< about d3
      gravity_cone,  ///< tilt of gravity about two axes normal to it
      table_frame,   ///< shift and rotation vector: six columns
    };
    Kind kind = Kind::number;
    int column = 0;          ///< the first
    ComponentSpread spread;  ///< of each column
    SceneParameter number;
    Place place;
    int axis = 0;            ///< of a shift

    int columns() const {
      return kind == Kind::table_frame ? 6 : kind == Kind::ball ? 3 : kind == Kind::cone || kind == Kind::gravity_cone ? 2 : 1;
    }
  };
  struct Correlated {
    std::vector<std::vector<int>> columns;  ///< by component: the members' columns
    Copula copula;
  };

  void add_numbers(const SceneEquilibrium& nominal, const Options& options, int variable);
  void add_place(const SceneEquilibrium& nominal, const Options& options, int variable);
  void add_gravity_cone(const SceneEquilibrium& nominal, const Options& options, int variable);
  void add_table_frames(const SceneEquilibrium& nominal, const Variable& variable, Piece piece, int number);
  void add_piece(Piece piece, const std::vector<std::string>& names, const char* unit, int variable, double nominal = 0);
  void add_groups(const Options& options);
  void add_contributors(const Options& options);
  bool from_table(const Piece& piece) const { return !tables_[piece.column].empty(); }
  void draw_piece(const Piece& piece, std::span<const double> u, std::span<double> values) const;
  void add_variance(const Piece& piece, Eigen::MatrixXd& covariance) const;
  void add_group_covariance(Eigen::MatrixXd& covariance) const;
  static Frame& frame_at(SystemProblem& problem, const Place& place);
  static void move(const Piece& piece, const double* by, double share, SystemProblem& problem);

  std::vector<Column> columns_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<double>> tables_;  ///< by column; empty: drawn
  std::vector<Correlated> groups_;
  std::vector<Contributor> contributors_;
  std::vector<int> first_column_ = {0};      ///< by variable, and one behind the last
};

}  // namespace tendril::variation
