// lockstep probe edge, angle, corner, bore, boss, tool, surface
#include <memory>

#include "clients/lockstep/measure/measure_run.hpp"
#include "clients/lockstep/verb.hpp"

namespace lockstep {
namespace {

using Options = std::shared_ptr<MeasureVerbOptions>;

constexpr const char* kTwice =
    "Each point is touched twice, first at five times the feed. The result is in machine coordinates.\n";

struct New {
    Verb verb;
    Options options;
};

New add(Verb probe, MeasureKind kind, const std::string& help, const std::string& example) {
    const Verb verb = probe.add_verb(std::string(name_of(kind)), help);
    const auto options = std::make_shared<MeasureVerbOptions>();
    options->measure.kind = kind;
    verb.add_option("--feed", options->measure.feed_mm_min, "speed of the slow touch, mm/min").required();
    verb.add_option("--back", options->measure.back_mm, "how far it moves off between its two touches, mm")
        .with_default();
    verb.add_option("--probe", options->measure.probe, "the probe's number; default: the machine's only one")
        .in_range(0, 63);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(kTwice + std::string(kInterrupted) + footer("  lockstep probe " + example + "\n"));
    verb.action([options] { return run_measurement(*options); });
    return {verb, options};
}

void add_tip(const New& made) {
    made.verb.add_option("--tip", made.options->measure.tip_mm, "the diameter of the probe's ball, mm").required();
}

void add_set(const New& made, const std::string& what) {
    made.verb.add_option("--set", made.options->set,
                         what + " of this coordinate system, G54 to G59, G59.1 to G59.3; default: it is only measured");
}

void add_words(const New& made, const std::string& help) {
    made.verb.add_option("words", made.options->measure.words, help).required();
}

void add_down(const New& made, const std::string& help) {
    made.verb.add_option("--down", made.options->measure.down_mm, help).required();
}

void add_diameter(const New& made) {
    made.verb.add_option("--diameter", made.options->measure.diameter_mm, "about its diameter, mm").required();
}

}  // namespace

void add_measurements(Verb probe) {
    const New edge = add(probe, MeasureKind::Edge,
                         "find an edge along X or Y\nThe tip stands beside it, at the height at which it is to touch.",
                         "edge X=15 --tip 2 --feed 60 --set G54");
    add_words(edge, "the farthest way to it from here: X=15 or Y=-15");
    add_tip(edge);
    add_set(edge, "the edge becomes the zero");

    const New angle = add(probe, MeasureKind::Angle,
                          "find the angle of an edge\nThe tip stands beside it, at the height at which it is to touch.",
                          "angle Y=15 --along 60 --feed 60");
    add_words(angle, "the farthest way to it from here: X=15 or Y=-15");
    angle.verb
        .add_option("--along", angle.options->measure.along_mm,
                    "from the first touch to the second, along the other axis, mm; may be negative")
        .required();
    add_set(angle, "the angle becomes the rotation");

    const New corner =
        add(probe, MeasureKind::Corner,
            "find an outer corner with edges along X and Y\nThe tip stands off both of its faces, at the "
            "height at which it is to touch.",
            "corner X=10 Y=10 --beside 8 --tip 2 --feed 60 --set G54");
    add_words(corner, "about where the corner is from here: X=10 Y=10");
    corner.verb.add_option("--beside", corner.options->measure.clearance_mm, "how far beside the corner it touches, mm")
        .required();
    add_tip(corner);
    add_set(corner, "the corner becomes the zero");

    const New bore =
        add(probe, MeasureKind::Bore,
            "find the centre and diameter of a bore\nThe tip stands in it, at the height at which it is to "
            "touch, within a fifth of the diameter of the centre. It ends in the centre.",
            "bore --diameter 25 --tip 2 --feed 60 --set G54");
    add_diameter(bore);
    add_tip(bore);
    add_set(bore, "the centre becomes the zero");

    const New boss =
        add(probe, MeasureKind::Boss,
            "find the centre and diameter of a boss\nThe tip stands above it, clear of it, within a fifth of "
            "the diameter of the centre. It ends above the centre.",
            "boss --diameter 20 --down 10 --clearance 5 --tip 2 --feed 60");
    add_diameter(boss);
    add_down(boss, "how far it goes down beside the boss, mm");
    boss.verb.add_option("--clearance", boss.options->measure.clearance_mm, "how far from the boss it does so, mm")
        .required();
    add_tip(boss);
    add_set(boss, "the centre becomes the zero");

    const New tool =
        add(probe, MeasureKind::Tool, "measure the length of a tool with a setter\nThe tool stands above the setter.",
            "tool --down 40 --setter 41.5 --feed 60 --probe 1 --tool 3");
    add_down(tool, "the farthest way down, mm");
    tool.verb
        .add_option("--setter", tool.options->measure.setter_mm,
                    "the place of Z, in machine coordinates, at which the setter touches without a tool, mm")
        .required();
    tool.verb.add_option("--tool", tool.options->tool, "set the length of this tool; default: it is only measured")
        .in_range(1, 99'999);

    const New surface =
        add(probe, MeasureKind::Surface,
            "measure the heights of a surface on a grid\nThe tip stands above it, clear of everything on "
            "the way to the first point. It ends above the first point.",
            "surface X=70:130 Y=50:110 --spacing 20 --down 15 --feed 60 --csv heights.csv");
    add_words(surface, "the first and last place of each axis, in machine coordinates: X=70:130 Y=50:110");
    surface.verb.add_option("--spacing", surface.options->measure.spacing_mm, "the greatest distance of two points, mm")
        .required();
    add_down(surface, "the farthest way down from here, mm");
    surface.verb.add_option("--csv", surface.options->csv, "write the points to this file, as x_mm,y_mm,z_mm");
}

}  // namespace lockstep
