#pragma once
// Texts as decks of Abaqus, CalculiX and Nastran: the models that the readers make of them, the
// errors that they end with, and the notes.
#include <algorithm>
#include <string>

#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "support/error_of.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {

inline FeReadOptions of_dialect(DeckDialect dialect) {
  FeReadOptions options;
  options.dialect = dialect;
  return options;
}

inline FeModel read_inp(const std::string& text, const FeReadOptions& options = {},
                        const std::string& file = "deck.inp") {
  TextSource source(text, file);
  return read_abaqus(source, options);
}

inline FeModel read_bdf(const std::string& text, const FeReadOptions& options = {},
                        const std::string& file = "arm.bdf") {
  TextSource source(text, file);
  return read_nastran(source, has_begin_bulk(text), options);
}

/// The same models, once they are found valid.
inline FeModel valid_inp(const std::string& text, const FeReadOptions& options = {},
                         const std::string& file = "deck.inp") {
  FeModel model = read_inp(text, options, file);
  validate(model);
  return model;
}

inline FeModel valid_bdf(const std::string& text) {
  FeModel model = read_bdf(text);
  validate(model);
  return model;
}

/// What is wrong with a text that is read, and with the model of one.
inline std::string inp_error(const std::string& text, const FeReadOptions& options = {},
                             const std::string& file = "deck.inp") {
  return error_of([&] { read_inp(text, options, file); });
}

inline std::string bdf_error(const std::string& text) {
  return error_of([&] { read_bdf(text); });
}

inline std::string invalid_inp(const std::string& text, const FeReadOptions& options = {}) {
  return error_of([&] { valid_inp(text, options); });
}

inline std::string invalid_bdf(const std::string& text) {
  return error_of([&] { valid_bdf(text); });
}

inline bool has_note(const FeModel& model, const std::string& note) {
  return std::find(model.notes.begin(), model.notes.end(), note) != model.notes.end();
}

}  // namespace floatframe::test
