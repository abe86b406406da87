// Numbers drawn from a seed: the same on every machine and library.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace lockstep::simtest {

class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}

    std::uint64_t bits() { return random_(); }
    /// A number in [0, 1).
    double part() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// A number in [low, high), evenly distributed.
    double real(double low, double high) { return low + (high - low) * part(); }
    /// A number in [low, high); each order of magnitude is equally likely. 0 < low.
    double magnitude(double low, double high) { return low * std::pow(high / low, part()); }
    /// A number in [low, high].
    std::int64_t whole(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    std::size_t index(std::size_t size) { return static_cast<std::size_t>(bits() % size); }
    bool chance(double probability) { return part() < probability; }
    template <typename T, std::size_t N>
    T any_of(const T (&choices)[N]) {
        return choices[index(N)];
    }

private:
    std::mt19937_64 random_;
};

}  // namespace lockstep::simtest
