// Colours that remain distinct for colour-blind readers and in print (after Okabe and Ito, 2008), and the chart's
// greys.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace lockstep::drawing::palette {

inline constexpr std::string_view kInk = "#1b2733";      // text and "commanded path"
inline constexpr std::string_view kSoftInk = "#5b6875";  // labels of axes
inline constexpr std::string_view kFrame = "#b8c1ca";
inline constexpr std::string_view kGrid = "#e8ecf0";
inline constexpr std::string_view kPaper = "#ffffff";
inline constexpr std::string_view kAlarm = "#c8323c";

inline constexpr std::array<std::string_view, 7> kSeries = {"#1f6fb4", "#e07b00", "#1a9367", "#b5559b",
                                                            "#3aa6d8", "#a8710f", "#6b5fc7"};

/// The colour of the i-th of several curves; they repeat after seven.
inline std::string series(std::size_t i) { return std::string(kSeries[i % kSeries.size()]); }

}  // namespace lockstep::drawing::palette
