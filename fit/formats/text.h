#pragma once
// Text files of measured formats as lines and words that know where they stand.
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

struct TextLine {
  int line = 0;           ///< from 1
  std::string_view text;  ///< trimmed; a view into the file's bytes
};

/// All lines, the blank ones too. InputError for bytes that are not text, for an empty file.
std::vector<TextLine> text_lines(std::string_view bytes, const std::string& file);

/// The words of a line: at commas where it has any (an empty cell is an empty word), else at blanks.
std::vector<std::string_view> words_of(std::string_view text);

/// Text as an error message or a note may show it: short and printable.
std::string printable(std::string_view text);

/// A whole number from 0 to `most`; InputError otherwise.
long whole_number(std::string_view text, std::string_view name, long most, const std::string& file, int line);

/// A zenith angle from 0 to 90 in degrees, from degrees or radians. InputError outside, NaN included; a π/2 that was
/// rounded up when it was written (by at most 1e-4 rad) is 90.
double zenith_deg(double angle, bool radians, std::string_view name, const std::string& file, int line);

/// Words one by one over the lines; lines that start with `comment` are left out.
class Words {
 public:
  Words(std::string_view bytes, const std::string& file, char comment);

  struct Word {
    int line = 0;
    std::string_view text;
  };
  bool end() const { return at_ == words_.size(); }
  /// InputError `file:line: ends …; expected …` past the last word.
  Word next(std::string_view expected);
  const Word* peek() const { return end() ? nullptr : &words_[at_]; }
  std::size_t left() const { return words_.size() - at_; }
  double number(std::string_view name);
  /// The next word has to be `name`.
  void expect(std::string_view name);
  /// A count and as many numbers, from lo to hi, increasing. The count is compared with what the file holds first.
  std::vector<double> counted_list(std::string_view name, double lo, double hi);
  /// The line of the word read last.
  int line() const { return at_ == 0 ? 1 : words_[at_ - 1].line; }

 private:
  const std::string& file_;
  std::vector<Word> words_;
  std::size_t at_ = 0;
};

}  // namespace gonio
