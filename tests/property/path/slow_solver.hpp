// The least time along a path, found slowly on a fine grid. Tests compare the planner with it.
//
// It shares nothing with the planner. The path is a list of places at equal distances; slopes and curvatures are their
// differences. Speeds are integrated place by place, backward and then forward, with the greatest change of speed that
// every axis allows. Sharp corners are separate places, at which an axis may jump by its start velocity. The solver
// ignores that jumps add up, so a machine may need more time than this, but never less.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lockstep::slow {

using Place = std::vector<double>;  // mm

/// In mm and s.
struct Axis {
    double start_velocity = 0;
    double max_velocity = 0;
    double acceleration = 0;
};

struct Grid {
    std::vector<Place> places;
    std::vector<bool> is_corner;  // the path turns sharply here
};

/// Straight moves, cut into equal steps of about `step_mm` each.
inline Grid grid_of_polyline(const std::vector<Place>& corners, double step_mm) {
    Grid grid;
    grid.places.push_back(corners.front());
    grid.is_corner.push_back(true);
    for (std::size_t k = 1; k < corners.size(); ++k) {
        double square = 0;
        for (std::size_t i = 0; i < corners[k].size(); ++i) {
            square += std::pow(corners[k][i] - corners[k - 1][i], 2);
        }
        const int steps = std::max(2, static_cast<int>(std::ceil(std::sqrt(square) / step_mm)));
        for (int n = 1; n <= steps; ++n) {
            Place at(corners[k].size());
            const double share = static_cast<double>(n) / steps;
            for (std::size_t i = 0; i < at.size(); ++i) {
                at[i] = corners[k - 1][i] + (corners[k][i] - corners[k - 1][i]) * share;
            }
            grid.places.push_back(at);
            grid.is_corner.push_back(n == steps);
        }
    }
    return grid;
}

/// A curve given by places close to each other.
inline Grid grid_of_curve(const std::vector<Place>& places) {
    Grid grid{.places = places, .is_corner = std::vector<bool>(places.size(), false)};
    grid.is_corner.front() = grid.is_corner.back() = true;
    return grid;
}

class Solver {
public:
    Solver(const Grid& grid, std::vector<Axis> axes, double feed) : grid_(grid), axes_(std::move(axes)), feed_(feed) {}

    double seconds() {
        const std::size_t n = grid_.places.size();
        for (std::size_t k = 0; k + 1 < n; ++k) { chords_.push_back(chord(k)); }
        std::vector<double> speed(n);
        for (std::size_t k = 0; k < n; ++k) { speed[k] = most_at(k); }
        for (std::size_t k = n - 1; k-- > 0;) { speed[k] = std::min(speed[k], changed(k, speed[k + 1], -1)); }
        for (std::size_t k = 0; k + 1 < n; ++k) { speed[k + 1] = std::min(speed[k + 1], changed(k, speed[k], 1)); }
        double seconds = 0;
        for (std::size_t k = 0; k + 1 < n; ++k) { seconds += chords_[k].mm / ((speed[k] + speed[k + 1]) / 2); }
        return seconds;
    }

private:
    struct Chord {
        double mm = 0;
        Place slope;
    };

    Chord chord(std::size_t k) const {
        Chord c;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            c.slope.push_back(grid_.places[k + 1][i] - grid_.places[k][i]);
            c.mm += c.slope[i] * c.slope[i];
        }
        c.mm = std::sqrt(c.mm);
        for (double& slope : c.slope) { slope /= c.mm; }
        return c;
    }

    /// Change of slope per mm at a place.
    double curvature(std::size_t k, std::size_t i) const {
        if (k == 0 || k + 1 >= grid_.places.size() || grid_.is_corner[k]) { return 0; }
        return (chords_[k].slope[i] - chords_[k - 1].slope[i]) / ((chords_[k].mm + chords_[k - 1].mm) / 2);
    }

    double most_at(std::size_t k) const {
        double most = feed_;
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            const double before = k > 0 ? chords_[k - 1].slope[i] : 0;
            const double after = k + 1 < grid_.places.size() ? chords_[k].slope[i] : 0;
            const double slope = std::max(std::abs(before), std::abs(after));
            if (slope > 0) { most = std::min(most, axes_[i].max_velocity / slope); }
            if (grid_.is_corner[k] && before != after) {
                most = std::min(most, axes_[i].start_velocity / std::abs(after - before));
            }
            const double c = std::abs(curvature(k, i));
            if (c > 0) { most = std::min(most, std::sqrt(axes_[i].acceleration / c)); }
        }
        return most;
    }

    /// The greatest speed at the other end of chord k; direction 1: at its end, -1: at its beginning.
    double changed(std::size_t k, double speed, int direction) const {
        double most = std::numeric_limits<double>::infinity();  // mm/s^2 along the path
        for (std::size_t i = 0; i < axes_.size(); ++i) {
            const double along = chords_[k].slope[i] * direction;
            if (along == 0) { continue; }
            const double bent = (curvature(k, i) + curvature(k + 1, i)) / 2 * speed * speed;
            const double left = along > 0 ? axes_[i].acceleration - bent : axes_[i].acceleration + bent;
            most = std::min(most, left / std::abs(along));
        }
        return std::sqrt(speed * speed + 2 * std::max(most, 0.0) * chords_[k].mm);
    }

    const Grid& grid_;
    std::vector<Axis> axes_;
    double feed_;
    std::vector<Chord> chords_;
};

}  // namespace lockstep::slow
