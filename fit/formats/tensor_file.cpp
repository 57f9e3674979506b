#include "fit/formats/tensor_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"

namespace gonio {
namespace {

static_assert(std::endian::native == std::endian::little, "tensor files are little-endian, and read as they are");

constexpr std::string_view kMagic("tensor_file\0", 12);
constexpr std::size_t kSmallestRecord = 2 + 1 + 2 + 1 + 8;  // a name of one letter, no extents

/// Walks through the header; every step is checked against the file's end.
struct HeaderReader {
  std::string_view bytes;
  const std::string& file;
  std::size_t at = 0;

  std::string_view take(std::size_t count, std::string_view what) {
    if (count > bytes.size() - at)
      throw input_error("{}: offset {}: ends within {}; expected {} bytes more, found {}", file, at, what, count,
                        bytes.size() - at);
    at += count;
    return bytes.substr(at - count, count);
  }
  template <class T>
  T number(std::string_view what) {
    T value;
    std::memcpy(&value, take(sizeof(T), what).data(), sizeof(T));
    return value;
  }
};

void read_prologue(HeaderReader& in) {
  if (in.take(kMagic.size(), "the first 12 bytes") != kMagic)
    throw input_error("{}: offset 0: is no tensor file; expected it to begin with tensor_file", in.file);
  const auto major = in.number<std::uint8_t>("the version"), minor = in.number<std::uint8_t>("the version");
  if (major != 1 || minor != 0)
    throw input_error("{}: offset {}: version is {}.{}; expected 1.0", in.file, in.at - 2, int(major), int(minor));
}

bool plain_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return c > 32 && c < 127; });
}

/// Bytes of a field's numbers; refused when they do not fit into the file (which also excludes an overflow).
std::uint64_t data_size(const Tensor& field, const HeaderReader& in) {
  std::uint64_t bytes = size_of(field.type);
  for (const std::uint64_t extent : field.shape) {
    if (extent == 0)
      throw input_error("{}: offset {}: field {} has an extent of 0; expected at least 1", in.file, field.record,
                        field.name);
    if (extent > in.bytes.size() / bytes)
      throw input_error("{}: offset {}: field {} claims more numbers than the file holds; expected at most {} bytes",
                        in.file, field.record, field.name, in.bytes.size());
    bytes *= extent;
  }
  return bytes;
}

Tensor read_record(HeaderReader& in) {
  Tensor field;
  field.record = in.at;
  field.name = in.take(in.number<std::uint16_t>("a field's name"), "a field's name");
  if (!plain_name(field.name))
    throw input_error("{}: offset {}: a field's name is no plain text; expected letters", in.file, field.record + 2);
  const auto dimensions = in.number<std::uint16_t>("a field's dimensions");
  const auto type = in.number<std::uint8_t>("a field's type");
  if (type < std::uint8_t(TensorType::uint8) || type > std::uint8_t(TensorType::float64))
    throw input_error("{}: offset {}: field {} has type {}; expected 1 to 11", in.file, in.at - 1, field.name,
                      int(type));
  field.type = TensorType(type);
  field.offset = in.number<std::uint64_t>("a field's offset");
  if (dimensions > (in.bytes.size() - in.at) / 8)
    throw input_error("{}: offset {}: field {} has {} extents, which end beyond the file; expected at most {}", in.file,
                      in.at, field.name, dimensions, (in.bytes.size() - in.at) / 8);
  for (int d = 0; d < dimensions; ++d) field.shape.push_back(in.number<std::uint64_t>("a field's extents"));
  const std::uint64_t size = data_size(field, in);
  if (field.offset > in.bytes.size() || size > in.bytes.size() - field.offset)
    throw input_error("{}: offset {}: field {} ends at {} + {}, beyond the file; expected at most {} bytes", in.file,
                      field.record, field.name, field.offset, size, in.bytes.size());
  field.bytes = in.bytes.substr(field.offset, size);
  return field;
}

/// Each once, none over the header, none over another.
void require_apart(std::vector<Tensor> fields, std::size_t header_end, const std::string& file) {
  std::sort(fields.begin(), fields.end(), [](const Tensor& a, const Tensor& b) { return a.offset < b.offset; });
  std::uint64_t end = header_end;
  std::string_view before = "the header";
  for (const Tensor& field : fields) {
    if (field.offset < end)
      throw input_error("{}: offset {}: field {} begins at {}, within {}; expected {} or more", file, field.record,
                        field.name, field.offset, before, end);
    end = field.offset + field.bytes.size();
    before = field.name;
  }
  std::sort(fields.begin(), fields.end(), [](const Tensor& a, const Tensor& b) { return a.name < b.name; });
  for (std::size_t k = 1; k < fields.size(); ++k)
    if (fields[k].name == fields[k - 1].name)
      throw input_error("{}: offset {}: field {} appears twice; expected each once", file, fields[k].record,
                        fields[k].name);
}

template <class T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::size_t aligned(std::size_t offset) { return (offset + 7) / 8 * 8; }

}  // namespace

std::size_t size_of(TensorType type) {
  static constexpr std::array<std::size_t, 12> kSizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
  return kSizes[std::size_t(type)];
}

std::vector<Tensor> parse_tensor_file(std::string_view bytes, const std::string& file) {
  HeaderReader in{bytes, file};
  read_prologue(in);
  const auto count = in.number<std::uint32_t>("the number of fields");
  if (count > (bytes.size() - in.at) / kSmallestRecord)
    throw input_error("{}: offset {}: claims {} fields, more than the file can hold; expected at most {}", file,
                      in.at - 4, count, (bytes.size() - in.at) / kSmallestRecord);
  std::vector<Tensor> fields;
  for (std::uint32_t k = 0; k < count; ++k) fields.push_back(read_record(in));
  require_apart(fields, in.at, file);
  return fields;
}

std::string tensor_file(const std::vector<Tensor>& fields) {
  std::size_t header = kMagic.size() + 2 + 4;
  for (const Tensor& field : fields) header += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  std::string out(kMagic);
  put(out, std::uint8_t{1});
  put(out, std::uint8_t{0});
  put(out, std::uint32_t(fields.size()));
  std::size_t offset = aligned(header);
  for (const Tensor& field : fields) {
    put(out, std::uint16_t(field.name.size()));
    out += field.name;
    put(out, std::uint16_t(field.shape.size()));
    put(out, std::uint8_t(field.type));
    put(out, std::uint64_t(offset));
    for (const std::uint64_t extent : field.shape) put(out, extent);
    offset = aligned(offset + field.bytes.size());
  }
  for (const Tensor& field : fields) {
    out.resize(aligned(out.size()), '\0');
    out += field.bytes;
  }
  return out;
}

std::vector<float> float_values(const Tensor& tensor, const std::string& file) {
  std::vector<float> values(tensor.bytes.size() / sizeof(float));
  std::memcpy(values.data(), tensor.bytes.data(), values.size() * sizeof(float));
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!std::isfinite(values[k]))
      throw input_error("{}: offset {}: {} of field {} is {}; expected a finite number", file,
                        tensor.offset + k * sizeof(float), k, tensor.name, values[k]);
  return values;
}

std::string float_bytes(const std::vector<float>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

}  // namespace gonio
