// The grammar of formulas, rule by rule: which operator takes which operands, and what is refused and where.
#include "framework/scene/units/formula_parser.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/units/expression.h"
#include "tests/refusal.h"

namespace pintle::formula_parser_test {
namespace {

// The expression with every operation in parentheses, a sign or function before its own.
std::string read(const std::string& text) {
  const Parameters none;
  const std::vector<Word> words = spell(text, {none});
  std::vector<std::string> results;
  for (const FormulaStep& step : parse(words)) {
    std::vector<std::string> x;
    for (int i = 0; i < step.operands; ++i) {
      x.insert(x.begin(), results.back());
      results.pop_back();
    }
    const std::string& word = step.word->text;
    if (x.empty())
      results.push_back(word);
    else if (x.size() == 2 && step.word->kind == Word::Kind::sign)
      results.push_back("(" + x[0] + word + x[1] + ")");
    else
      results.push_back(word + "(" + x[0] + (x.size() > 1 ? "," + x[1] : "") + (x.size() > 2 ? "," + x[2] : "") + ")");
  }
  EXPECT_EQ(results.size(), 1u) << text;
  return results.back();
}

std::string refusal(const std::string& text) {
  return pintle_test::refusal_by<ExpressionError>([&] { read_quantity(text); });
}

// What comes after the text itself.
void expect_refused(const std::string& text, const std::string& said) {
  const std::string all = refusal(text);
  EXPECT_TRUE(all.starts_with("\"" + text + "\"" + said)) << all;
}

double number(const std::string& text) { return read_quantity(text, dimension::number); }

// From weak to strong; those in one row bind alike.
const std::vector<std::vector<std::string>> rows{{"||"}, {"&&"}, {"<", "<=", ">", ">=", "==", "!="}, {"+", "-"}, {"*", "/"}, {"^"}};

constexpr std::size_t comparisons = 2;  // which do not follow one another

TEST(Grammar, StrongerOperatorTakesTheOperandBetweenTwo) {
  for (std::size_t weak = 0; weak < rows.size(); ++weak)
    for (std::size_t strong = weak + 1; strong < rows.size(); ++strong)
      for (const std::string& w : rows[weak])
        for (const std::string& s : rows[strong]) {
          EXPECT_EQ(read("a" + w + "b" + s + "c"), "(a" + w + "(b" + s + "c))");
          EXPECT_EQ(read("a" + s + "b" + w + "c"), "((a" + s + "b)" + w + "c)");
        }
}

TEST(Grammar, OperatorsThatBindAlikeAreReadFromTheLeft) {
  for (std::size_t row = 0; row + 1 < rows.size(); ++row)
    for (const std::string& first : rows[row])
      for (const std::string& second : rows[row])
        if (row != comparisons) {
          EXPECT_EQ(read("a" + first + "b" + second + "c"), "((a" + first + "b)" + second + "c)");
        }
}

TEST(Grammar, PowersAreReadFromTheRight) {
  EXPECT_EQ(read("a^b^c"), "(a^(b^c))");
  EXPECT_EQ(read("a^b^c^d*e"), "((a^(b^(c^d)))*e)");
  EXPECT_EQ(number("2^3^2"), 512);
}

TEST(Grammar, SignBindsLessThanAPowerAndMoreThanAProduct) {
  EXPECT_EQ(read("-a^b"), "-((a^b))");
  EXPECT_EQ(read("-a*b"), "(-(a)*b)");
  EXPECT_EQ(read("-a+b"), "(-(a)+b)");
  EXPECT_EQ(read("-a<b"), "(-(a)<b)");
  EXPECT_EQ(read("a^-b"), "(a^-(b))");
  EXPECT_EQ(read("a^-b^c"), "(a^-((b^c)))");
  EXPECT_EQ(read("a^-b*c"), "((a^-(b))*c)");
  EXPECT_EQ(number("-2^-2"), -0.25);
}

TEST(Grammar, SignMayFollowAnyOperator) {
  for (const auto& row : rows)
    for (const std::string& o : row) {
      EXPECT_EQ(read("a" + o + "-b"), "(a" + o + "-(b))");
      EXPECT_EQ(read("a" + o + "+b"), "(a" + o + "b)");
    }
  EXPECT_EQ(read("+a"), "a");
  EXPECT_EQ(read("sin(-a)"), "sin(-(a))");
  EXPECT_EQ(read("min(a, -b)"), "min(a,-(b))");
}

TEST(Grammar, SecondSignNeedsParentheses) {
  EXPECT_EQ(read("-(-a)"), "-(-(a))");
  EXPECT_EQ(read("a--b"), "(a--(b))");
  expect_refused("--2", ", character 2: a second sign needs parentheses");
  expect_refused("-+2", ", character 2: a second sign");
  expect_refused("2 - + -3", ", character 7: a second sign");
  expect_refused("2^--3", ", character 4: a second sign");
}

TEST(Grammar, ParenthesesGoFirst) {
  EXPECT_EQ(read("(a+b)*c"), "((a+b)*c)");
  EXPECT_EQ(read("(a^b)^c"), "((a^b)^c)");
  EXPECT_EQ(read("((a))"), "a");
}

TEST(Grammar, FunctionsTakeWhatTheirArgumentsAre) {
  EXPECT_EQ(read("sin(a+b)*c"), "(sin((a+b))*c)");
  EXPECT_EQ(read("-sin(a)^b"), "-((sin(a)^b))");
  EXPECT_EQ(read("sin (a)"), "sin(a)");
  EXPECT_EQ(read("atan2(a, b+c)"), "atan2(a,(b+c))");
  EXPECT_EQ(read("if(a < b && c, d, e || f)"), "if(((a<b)&&c),d,(e||f))");
  EXPECT_EQ(read("step(a, b, c)"), "step(a,b,c)");
  EXPECT_EQ(read("min(a)"), "a");
  EXPECT_EQ(read("min(a, b, c, d)"), "min(min(min(a,b),c),d)");
  EXPECT_EQ(read("max(a, min(b, c), d)"), "max(max(a,min(b,c)),d)");
}

TEST(Grammar, ComparisonsAnswerOneOrZero) {
  EXPECT_EQ(number("1 < 2"), 1);
  EXPECT_EQ(number("1 < 0.5 || 3 > 2 && 2 > 1"), 1);
  EXPECT_EQ(number("1 || 0 && 0"), 1);
  EXPECT_EQ(number("-1 && 2"), 1);
}

// In mathematics 0 < u < 1 asks for both; compared with 1 would be whether the first holds.
TEST(Grammar, ComparisonsInARowAreRefusedWithTheRemedy) {
  const std::array<std::string, 6> signs{"<", ">", "<=", ">=", "==", "!="};
  for (const std::string& first : signs)
    for (const std::string& second : signs)
      for (const auto& [open, close] :
           {std::pair{"1 + 0 ", ""}, std::pair{"2*(3 ", ")"}, std::pair{"if(3 ", ", 1, 2)"}, std::pair{"1 && 3 ", ""}})
        EXPECT_NE(refusal(open + first + " 2 " + second + " 1" + close).find("join two by &&, as in 0 < u && u < 1"), std::string::npos)
            << open << first << second;
  EXPECT_EQ(number("(3 > 2) == 1"), 1);
  EXPECT_EQ(number("(3 > 2) == (2 > 1)"), 1);
}

TEST(Grammar, NumbersAreDecimal) {
  EXPECT_EQ(number("1e-3"), 1e-3);
  EXPECT_EQ(number("1E3"), 1e3);
  EXPECT_EQ(number("1e+3"), 1e3);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("5.e2"), 500);
  EXPECT_EQ(number("007"), 7);
  EXPECT_EQ(read_quantity("1e5m").value, 1e5);
  expect_refused("0x10", ", character 2: there is no operator between 0 and x10");
  expect_refused("0b1", ", character 2: there is no operator between 0 and b1");
  expect_refused("1_000", ", character 2: there is no operator between 1 and _000");
  expect_refused("1.2.3", ", character 4: there is no operator between 1.2 and .3");
  expect_refused("1e", ", character 2: there is no operator between 1 and e, and e is not a unit here: Euler's number is exp(1)");
  expect_refused("1 + 1e-400", ", character 5: 1e-400 is too large or too small");
}

TEST(Refusal, NamesWhatStandsWhereAValueShould) {
  expect_refused("2 * * 3", ", character 5: the operator * is where a value should be");
  expect_refused("&& 1", ", character 1: the operator && is where a value should be");
  expect_refused("1 <> 2", ", character 4: the operator > is where a value should be");
  expect_refused("2*()", ", character 4: a parenthesis is where a value should be");
  expect_refused("(1 +)", ", character 5: a parenthesis is where a value should be");
  expect_refused("min(1,)", ", character 7: a parenthesis is where a value should be");
  expect_refused("min(,1)", ", character 5: a comma is where a value should be");
}

TEST(Refusal, SaysAfterWhatItEnds) {
  expect_refused("2*", ", character 2: it ends too early: nothing follows *");
  expect_refused("1 + -", ", character 5: it ends too early: nothing follows -");
}

TEST(Refusal, PointsToTheParenthesisOrComma) {
  expect_refused("2*(3 + (4)", ", character 3: a parenthesis is not closed");
  expect_refused("2 + 3)", ", character 6: a parenthesis is closed but was not opened");
  expect_refused("2*(1, 2)", ", character 5: a comma is outside a function");
  expect_refused("1,5", ", character 2: a comma is outside a function");
}

TEST(Refusal, CountsArgumentsOfAFunction) {
  expect_refused("1 + sin(1, 2)", ", character 5: sin has too many arguments: 2 instead of 1");
  expect_refused("sin()", ", character 1: sin has too few arguments: 0 instead of 1");
  expect_refused("atan2(1)", ", character 1: atan2 has too few arguments: 1 instead of 2");
  expect_refused("if(1, 2)", ", character 1: if has too few arguments: 2 instead of 3");
  expect_refused("max()", ", character 1: max has too few arguments: 0 instead of 1 or more");
}

TEST(Refusal, OfANameHasTheNearestOne) {
  expect_refused("1 + sine(1)", ", character 5: there is no function \"sine\". Did you mean \"sin\"?");
  expect_refused("2*ln(2)", ", character 3: there is no function \"ln\": the natural logarithm is log");
  expect_refused("2*gpa", ", character 3: \"gpa\" is neither a parameter nor a unit. Did you mean \"GPa\"?");
  expect_refused("1 + sin", ", character 5: the function sin needs parentheses");
}

TEST(Refusal, OfAnOperationPointsToItsOperator) {
  expect_refused("2 kg + 1 m", ", character 6: + mixes");
  expect_refused("2 m + max(1 m, 3 s)", ", character 7: max mixes");
  expect_refused("2 - 1/0", ", character 6: a part of it is not a finite number");
  expect_refused("2^(1 m)", ", character 2: an exponent must be a number");
}

TEST(Refusal, CountsCharactersAsWrittenNotBytes) {
  expect_refused("3 µm² + 4°", ", character 7: + mixes");
  expect_refused("π·%", ", character 3: \"%\" has no meaning");
}

TEST(Refusal, OfALawPointsToThePlaceToo) {
  const Parameters speed{{"speed", {150, dimension::angular_speed}}};
  const std::string said = pintle_test::refusal_by<ExpressionError>([&] { read_law("speed*t + sin(10*t)", dimension::angle, speed); });
  EXPECT_TRUE(said.starts_with("\"speed*t + sin(10*t)\", character 11: sin needs")) << said;
}

std::string nested(const std::string& open, int times, const std::string& inside, const std::string& close) {
  std::string out;
  for (int i = 0; i < times; ++i) out += open;
  out += inside;
  for (int i = 0; i < times; ++i) out += close;
  return out;
}

TEST(Depth, OfAHundredIsRead) {
  EXPECT_EQ(number(nested("(", 100, "1", ")")), 1);
  EXPECT_EQ(number(nested("-(", 100, "1", ")")), 1);
  EXPECT_EQ(number(nested("1 + (", 100, "1", ")")), 101);
  EXPECT_EQ(number(nested("1^", 100, "1", "")), 1);
  EXPECT_EQ(number(nested("abs(", 100, "1", ")")), 1);
}

TEST(Depth, OfManyIsRefused) {
  const std::string said = "it nests too deeply";
  EXPECT_NE(refusal(nested("(", 900, "1", ")")).find(said), std::string::npos);
  EXPECT_NE(refusal(nested("-(", 600, "1", ")")).find(said), std::string::npos);
  EXPECT_NE(refusal(nested("1^", 900, "1", "")).find(said), std::string::npos);
  EXPECT_NE(refusal(nested("abs(", 300, "1", ")")).find(said), std::string::npos);
}

TEST(Depth, OfManyIsRefusedHoweverLongTheText) {
  const std::vector<Word> open(1000000, {Word::Kind::open, "(", 1});
  EXPECT_THROW(parse(open), ExpressionError);
  const std::vector<Word> power(1000000, {Word::Kind::sign, "-", 1});
  EXPECT_THROW(parse(power), ExpressionError);
  std::vector<Word> powers;
  for (int i = 0; i < 500000; ++i) {
    powers.push_back({Word::Kind::name, "a", 1});
    powers.push_back({Word::Kind::sign, "^", 1});
  }
  EXPECT_THROW(parse(powers), ExpressionError);
}

TEST(Parser, RefusesWordsThatNoTextIsSpelledTo) {
  using Kind = Word::Kind;
  const Word open{Kind::open, "(", 1}, close{Kind::close, ")", 2}, a{Kind::name, "a", 3}, sin{Kind::function, "sin", 4},
      unknown_sign{Kind::sign, "!", 5};
  for (const std::vector<Word>& words : std::vector<std::vector<Word>>{{},
                                                                       {open},
                                                                       {close},
                                                                       {a, close},
                                                                       {open, a},
                                                                       {a, a},
                                                                       {sin},
                                                                       {sin, a},
                                                                       {sin, open},
                                                                       {sin, open, a},
                                                                       {sin, a, a, close},
                                                                       {a, unknown_sign, a}})
    EXPECT_THROW(parse(words), ExpressionError);
}

}  // namespace
}  // namespace pintle::formula_parser_test
