#include "clients/drawing/svg.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace lockstep::drawing {
namespace {

constexpr std::string_view kFont = "'DejaVu Sans','Segoe UI',Helvetica,Arial,sans-serif";

/// Rounds to hundredths of a pixel, which is finer than any screen.
void append_number(std::string& out, double value) {
    std::array<char, 32> text{};
    const double rounded = std::round(value * 100) / 100 + 0.0;  // + 0.0: no "-0"
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), rounded);
    out.append(text.data(), error == std::errc{} ? end : text.data());
}

std::string_view name_of(Anchor anchor) {
    switch (anchor) {
        case Anchor::Start: return "start";
        case Anchor::Middle: return "middle";
        case Anchor::End: break;
    }
    return "end";
}

bool is_forbidden(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

}  // namespace

std::string escape_xml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            default: out += is_forbidden(c) ? '?' : c;
        }
    }
    return out;
}

double text_width(std::string_view text, const TextStyle& style) {
    std::size_t characters = 0;
    for (const char c : text) { characters += begins_character(c) ? 1U : 0U; }
    return static_cast<double>(characters) * style.size * (style.bold ? 0.68 : 0.61);
}

Svg::Svg(double width, double height, std::string_view title) {
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" font-family=\"";
    out_ += kFont;
    out_ += '"';
    attribute("width", width);
    attribute("height", height);
    out_ += " viewBox=\"0 0 ";
    append_number(out_, width);
    out_ += ' ';
    append_number(out_, height);
    out_ += "\">\n<title>" + escape_xml(title) + "</title>\n";
    rectangle({0, 0, width, height}, palette::kPaper);
}

void Svg::attribute(std::string_view name, double value) {
    out_ += ' ';
    out_ += name;
    out_ += "=\"";
    append_number(out_, value);
    out_ += '"';
}

void Svg::attribute(std::string_view name, std::string_view value) {
    out_ += ' ';
    out_ += name;
    out_ += "=\"" + escape_xml(value) + '"';
}

void Svg::stroke(const Stroke& stroke) {
    attribute("stroke", stroke.colour);
    attribute("stroke-width", stroke.width);
    if (stroke.opacity < 1) { attribute("stroke-opacity", stroke.opacity); }
    if (stroke.dashed) { attribute("stroke-dasharray", "5 4"); }
}

void Svg::rectangle(const Box& box, std::string_view fill, double opacity) {
    out_ += "<rect";
    attribute("x", box.x);
    attribute("y", box.y);
    attribute("width", box.width);
    attribute("height", box.height);
    attribute("fill", fill);
    if (opacity < 1) { attribute("fill-opacity", opacity); }
    out_ += "/>\n";
}

void Svg::line(Point from, Point to, const Stroke& style) {
    out_ += "<line";
    attribute("x1", from.x);
    attribute("y1", from.y);
    attribute("x2", to.x);
    attribute("y2", to.y);
    stroke(style);
    out_ += "/>\n";
}

void Svg::path(const std::vector<std::vector<Point>>& lines, const Stroke& style) {
    out_ += "<path fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
    stroke(style);
    points(lines);
    out_ += "/>\n";
}

void Svg::area(const std::vector<std::vector<Point>>& shapes, std::string_view fill, double opacity) {
    out_ += "<path";
    attribute("fill", fill);
    attribute("fill-opacity", opacity);
    points(shapes);
    out_ += "/>\n";
}

void Svg::points(const std::vector<std::vector<Point>>& lines) {
    out_ += " d=\"";
    for (const auto& points : lines) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            out_ += i == 0 ? 'M' : (i == 1 ? 'L' : ' ');
            append_number(out_, points[i].x);
            out_ += ',';
            append_number(out_, points[i].y);
        }
        if (points.size() == 1) { out_ += "h0"; }  // draws a single point as a round dot
    }
    out_ += '"';
}

void Svg::dot(Point at, double radius, std::string_view colour) {
    out_ += "<circle";
    attribute("cx", at.x);
    attribute("cy", at.y);
    attribute("r", radius);
    attribute("fill", colour);
    attribute("stroke", palette::kPaper);
    out_ += "/>\n";
}

void Svg::text(Point at, std::string_view content, const TextStyle& style) {
    out_ += "<text";
    attribute("x", at.x);
    attribute("y", at.y);
    attribute("font-size", style.size);
    attribute("fill", style.colour);
    if (style.bold) { attribute("font-weight", "bold"); }
    if (style.halo) {
        attribute("stroke", palette::kPaper);
        attribute("stroke-width", 3);
        attribute("paint-order", "stroke");
    }
    if (style.anchor != Anchor::Start) { attribute("text-anchor", name_of(style.anchor)); }
    out_ += '>' + escape_xml(content) + "</text>\n";
}

std::string Svg::finish() && {
    out_ += "</svg>\n";
    return std::move(out_);
}

}  // namespace lockstep::drawing
