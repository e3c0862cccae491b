// Arrays for NumPy: numpy.load("cloth.npz")["positions"]. The file is a zip archive of one .npy file for each
// array, not compressed (NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays", version 1.0).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace clothsim {

struct NamedArray {
  std::string name;
  std::string type;                // as NumPy names it, little-endian: "<f4", "<f8", "<u4", "<i8"
  std::vector<std::size_t> shape;  // rows first; empty for a single number
  std::string bytes;               // the last index runs fastest
};

// `numbers` are as many as the shape says.
template <class Number>
[[nodiscard]] NamedArray namedArray(std::string name, std::vector<std::size_t> shape,
                                    std::span<const Number> numbers) {
  constexpr char kind = std::is_floating_point_v<Number> ? 'f' : std::is_signed_v<Number> ? 'i' : 'u';
  return {std::move(name), std::string("<") + kind + std::to_string(sizeof(Number)), std::move(shape),
          std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes())};
}

// The same arrays give the same bytes. @throws InputOutputError when there is not enough memory
[[nodiscard]] std::string formatNpz(const std::vector<NamedArray>& arrays);

}  // namespace clothsim
