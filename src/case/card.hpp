#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/placement.hpp"

namespace hemomag::case_ {

/// A note is no reproach: something to know about the case.
enum class Verdict { fine, note, doubtful, refused };

/// One line of the card: a number, its verdict, and what to change when it is not fine.
struct CardLine {
  std::string name;
  std::string value;
  Verdict verdict = Verdict::fine;
  std::string advice;    ///< what is accepted, or what would be better
  std::string position;  ///< of the part of the case file it is about
};

/// What a case means before it is run: units, dimensionless numbers, stability, cost. Limits:
/// docs/card.md.
struct Card {
  std::vector<CardLine> lines;
  bool refused() const;
  std::string print() const;
  /// The refused lines alone, as error messages.
  std::string refusals() const;
};

Card make_card(const Case& c, const std::vector<CellModel>& models);

}  // namespace hemomag::case_
