#include "clients/simulation/sliding_rows.hpp"

namespace lockstep {

std::expected<void, std::string> SlidingRows::append(std::span<const double> rows) {
    numbers_.insert(numbers_.end(), rows.begin(), rows.end());
    most_kept_ = std::max(most_kept_, kept());
    return {};
}

bool SlidingRows::read(std::uint32_t number, std::span<double> row) {
    if (number < first_ || number - first_ >= kept()) { return false; }
    std::copy_n(numbers_.begin() + static_cast<std::ptrdiff_t>((number - first_) * width_), width_, row.begin());
    return true;
}

std::uint64_t SlidingRows::free_rows() { return most_rows_ - std::min(most_rows_, kept()); }

void SlidingRows::release_before(std::uint32_t number) {
    if (number <= first_ + 1) { return; }
    const std::uint64_t released = std::min<std::uint64_t>(number - 1 - first_, kept());
    numbers_.erase(numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(released * width_));
    first_ += static_cast<std::uint32_t>(released);
}

}  // namespace lockstep
