#pragma once
// The tensor file: named arrays of numbers in one binary file, the container of the RGL database
// (Dupuy & Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and Rendering", ACM TOG 37(6), 2018,
// doi:10.1145/3272127.3275059; https://rgl.epfl.ch/materials).
//   "tensor_file\0", version 1.0 (two bytes), number of fields (uint32), then for each field: length of its name (uint16),
//   name, number of dimensions (uint16), type (uint8), offset of its data (uint64), extents (uint64 each). Little-endian.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// Codes of the number types, in the file's own numbering.
enum class TensorType : std::uint8_t {
  uint8 = 1,
  int8,
  uint16,
  int16,
  uint32,
  int32,
  uint64,
  int64,
  float16,
  float32,
  float64
};

/// Bytes of one number.
std::size_t size_of(TensorType type);

struct Tensor {
  std::string name;
  TensorType type = TensorType::float32;
  std::vector<std::uint64_t> shape;  ///< slowest first
  std::string_view bytes;            ///< the numbers, a view into the file
  std::uint64_t record = 0;          ///< where the field is described, for messages
  std::uint64_t offset = 0;          ///< where its numbers begin
};

/// InputError `file: offset N: …` unless every field lies whole in the file, apart from the header and from the others.
std::vector<Tensor> parse_tensor_file(std::string_view bytes, const std::string& file);

/// The file of these fields, data in their order, each begun at a multiple of 8 bytes; `offset` and `record` are not looked at.
std::string tensor_file(const std::vector<Tensor>& fields);

/// The numbers of a float32 field. InputError for one that is not finite.
std::vector<float> float_values(const Tensor& tensor, const std::string& file);

/// The bytes of float32 numbers.
std::string float_bytes(const std::vector<float>& values);

}  // namespace gonio
