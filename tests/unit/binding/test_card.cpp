#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "binding/card.h"

using tendril::Card;
using tendril::plain_number;
using tendril::quantity;
using tendril::table_text;

TEST_CASE("plain numbers have 4 significant digits") {
  CHECK(plain_number(0) == "0");
  CHECK(plain_number(1) == "1");
  CHECK(plain_number(-1.5) == "-1.5");
  CHECK(plain_number(3.14159265) == "3.142");
  CHECK(plain_number(123.456) == "123.5");
  CHECK(plain_number(99999) == "100000");
  CHECK(plain_number(123456) == "123500");
  CHECK(plain_number(0.00012345) == "0.0001234");
  CHECK(plain_number(0.000012345) == "1.234e-05");
  CHECK(plain_number(1.5e6) == "1.5e+06");
  CHECK(plain_number(99.996) == "100");
  CHECK(plain_number(std::numeric_limits<double>::infinity()) == "infinite");
  CHECK(plain_number(-std::numeric_limits<double>::infinity()) == "-infinite");
  CHECK(plain_number(std::numeric_limits<double>::quiet_NaN()) == "unknown");
}

TEST_CASE("quantities take the multiple of their unit that suits their size") {
  const auto [value, unit, text] = GENERATE(table<double, std::string, std::string>({
      {1.25, "m", "1.25 m"},         {0.0123, "m", "12.3 mm"},    {-0.0123, "m", "-12.3 mm"}, {4.2e-6, "m", "4.2 um"},
      {1, "m", "1 m"},               {0.001, "m", "1 mm"},        {0.99999, "m", "1 m"},      {0, "m", "0 m"},
      {12345, "m", "12340 m"},       {2.5e-5, "s", "25 us"},      {0.0351, "s", "35.1 ms"},   {61.2, "s", "61.2 s"},
      {3e-12, "s", "0.003 ns"},      {0.5, "N", "500 mN"},        {1999, "N", "1.999 kN"},    {0.003, "J", "3 mJ"},
      {6e6, "Pa", "6 MPa"},          {2.1e11, "Pa", "210 GPa"},   {0.25, "kg", "250 g"},      {0.02, "N m", "20 mN m"},
      {0.2, "kg/m", "200 g/m"},      {3.14159265358979, "rad", "180 deg"}, {12, "1/m", "12 1/m"}, {0.01, "N m^2", "0.01 N m^2"},
      {7, "", "7"},
  }));
  INFO(value << " " << unit);
  CHECK(quantity(value, unit) == text);
}

TEST_CASE("a quantity that is no number has no unit") {
  CHECK(quantity(std::numeric_limits<double>::infinity(), "m") == "infinite");
  CHECK(quantity(std::numeric_limits<double>::quiet_NaN(), "m") == "unknown");
}

TEST_CASE("a card aligns its rows") {
  const std::string text = Card("equilibrium: solved")
                               .row("time", 3.5e-5, "s")
                               .row("residual", 2e-9, "N", "largest force")
                               .row("\xC3\xA4rger", "none", "in a column")
                               .text();
  CHECK(text ==
        "equilibrium: solved\n"
        "  time      35 us\n"
        "  residual  2 nN  largest force\n"
        "  \xC3\xA4rger     none  in a column");
  CHECK(Card("only a title").text() == "only a title");
}

TEST_CASE("a table aligns its columns, numbers to the right") {
  CHECK(table_text({"name", "N", "what"}, {{"a", "10", "x"}, {"longer", "5"}}) ==
        "name     N  what\n"
        "a       10  x\n"
        "longer   5");
  CHECK(table_text({"a"}, {}) == "a");
}

TEST_CASE("a row of bars on a logarithmic scale") {
  using tendril::sparkline;
  CHECK(sparkline({}, true).empty());
  CHECK(sparkline({5}, false) == "#");
  CHECK(sparkline({1, 1, 1}, false) == "###");
  CHECK(sparkline({1e8, 1e7, 1e6, 1e5, 1e4, 1e3, 1e2, 1e1, 1e0}, false) == "##*+=~-._");
  CHECK(sparkline({1e8, 1e4, 1e0}, true) == "\u2588\u2585\u2581");
  CHECK(sparkline({1, 0, -1, std::numeric_limits<double>::quiet_NaN(), 1e-3}, false) == "#____");
  // Of many as many as there is room for, the first and the last among them.
  std::vector<double> falling;
  for (int i = 0; i < 1000; ++i) falling.push_back(std::pow(10, -i / 100.0));
  const std::string bars = sparkline(falling, false, 16);
  CHECK(bars.size() == 16);
  CHECK(bars.front() == '#');
  CHECK(bars.back() == '_');
  const std::string heights = "_.-~=+*#";
  for (std::size_t i = 1; i < bars.size(); ++i) CHECK(heights.find(bars[i]) <= heights.find(bars[i - 1]));
}
