#pragma once
// materials: what is known of materials, lights and eyes (materials_db/), read, range-checked, looked up by id.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "optics/interface.h"

namespace gonio {

/// One entry of the database. Wavelengths in nm. Columns by kind: optical-constants n[, k]; reflectance, transmittance,
/// illuminant, luminous-efficiency one column; observer (xbar, ybar, zbar), cone-fundamentals (l, m, s), rgb-observer
/// (rbar, gbar, bbar), daylight-basis (S0, S1, S2) three. A dispersion formula stands for n; a table of k may follow.
struct Entry {
  std::string id, name, kind, unit, specimen, temperature, method, citation, doi, licence, confidence, note;
  double range_lo_nm = 0, range_hi_nm = 0;    ///< what the entry covers
  double source_lo_nm = 0, source_hi_nm = 0;  ///< what its source covers
  std::string formula;                        ///< empty for a table; "sellmeier-2" … (refractiveindex.info's names)
  std::vector<double> coefficients;           ///< of the formula, wavelength in µm
  std::vector<double> wavelength_nm;          ///< of the table, increasing
  std::vector<std::string> column_names;
  std::vector<std::vector<double>> columns;  ///< columns[c][row]; n of a formula has none
  std::string file;                          ///< where it was read
  bool user = false;                         ///< of the user's own database, not bundled

  bool has_k() const;
  /// Column c at a wavelength: linear between points, or the formula. InputError outside the entry's range (never
  /// extended).
  double at(double wavelength_nm, std::size_t column = 0) const;
};

class Database {
 public:
  /// The compiled materials_db (materials.sqlite) and the user's own database beside it, entries read when asked for.
  static const Database& bundled();
  /// A compiled database, or a folder of text entries like materials_db (broken entries throw when asked for).
  explicit Database(const std::string& path);
  ~Database();

  /// By id or alias; InputError for an unknown one, naming near ones.
  const Entry& find(std::string_view id_or_alias) const;
  bool contains(std::string_view id_or_alias) const;
  /// The full id behind an alias (itself for an id).
  std::string full_id(std::string_view id_or_alias) const;
  /// Every id, in order; reads no entry.
  std::vector<std::string> ids() const;
  /// The aliases of a full id.
  std::vector<std::string> aliases_of(std::string_view id) const;
  /// Every entry that can be read, by id.
  std::vector<const Entry*> all() const;
  /// Entries whose id, alias, name, kind or citation has words that begin with every word of the query (without regard
  /// to case and accents), best first.
  std::vector<const Entry*> search(std::string_view words) const;
  /// What is wrong with it, one line each: every entry is read and checked.
  std::vector<std::string> findings() const;

 private:
  struct State;
  explicit Database(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A material as the models see it: its surface in air at a wavelength, and the range where that is known.
/// `perfect` reflects 1 at every angle and wavelength. A `reflectance` entry gives n from R0 (Cook & Torrance), k = 0,
/// and `from_reflectance` is set, which every result mentions.
class SurfaceMaterial {
 public:
  explicit SurfaceMaterial(std::string_view id_or_alias, const Database& database = Database::bundled());
  static SurfaceMaterial perfect();

  const std::string& id() const { return id_; }
  bool is_perfect() const { return entry_ == nullptr; }
  bool from_reflectance() const { return from_reflectance_; }
  const Entry* entry() const { return entry_; }
  double range_lo_nm() const;  ///< 0 for `perfect`
  double range_hi_nm() const;  ///< infinity for `perfect`
  /// InputError outside the range, or where k is not known. A formula's medium whose k nowhere exceeds 1e-4 counts as
  /// transparent outside its table of k: that changes no reflectance by more than 1e-8.
  Interface<double> at(double wavelength_nm) const;

 private:
  SurfaceMaterial() = default;
  std::string id_;
  const Entry* entry_ = nullptr;
  bool from_reflectance_ = false;
};

}  // namespace gonio
