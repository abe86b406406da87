#include "services/documents/workpiece/workpiece_proto.hpp"

#include <fmt/format.h>

namespace lockstep {
namespace {

constexpr double kUsualWaveLength_mm = 100;

/// The place and the size of a bore or a post.
void read_round(const auto& message, const std::string& at, auto& round, ProtoReader& reader) {
    reader.require(message.has_x_mm(), message.x_mm(), round.x_mm, at + ".x_mm");
    reader.require(message.has_y_mm(), message.y_mm(), round.y_mm, at + ".y_mm");
    reader.require(message.has_diameter_mm(), message.diameter_mm(), round.diameter_mm, at + ".diameter_mm");
}

void write_round(const auto& round, auto& message) {
    message.set_x_mm(round.x_mm);
    message.set_y_mm(round.y_mm);
    message.set_diameter_mm(round.diameter_mm);
}

WorkBlock read_block(const proto::WorkBlock& message, const std::string& at, ProtoReader& reader) {
    WorkBlock block{.rise_x = message.rise_x(),
                    .rise_y = message.rise_y(),
                    .wave_mm = message.wave_mm(),
                    .wave_length_mm = message.has_wave_length_mm() ? message.wave_length_mm() : kUsualWaveLength_mm,
                    .bores = {},
                    .angle_deg = message.angle_deg(),
                    .probe = message.probe()};
    reader.require(message.has_x_min_mm(), message.x_min_mm(), block.x_min_mm, at + ".x_min_mm");
    reader.require(message.has_x_max_mm(), message.x_max_mm(), block.x_max_mm, at + ".x_max_mm");
    reader.require(message.has_y_min_mm(), message.y_min_mm(), block.y_min_mm, at + ".y_min_mm");
    reader.require(message.has_y_max_mm(), message.y_max_mm(), block.y_max_mm, at + ".y_max_mm");
    reader.require(message.has_top_mm(), message.top_mm(), block.top_mm, at + ".top_mm");
    for (int k = 0; k < message.bore_size(); ++k) {
        read_round(message.bore(k), fmt::format("{}.bore[{}]", at, k), block.bores.emplace_back(), reader);
    }
    return block;
}

WorkPost read_post(const proto::WorkPost& message, const std::string& at, ProtoReader& reader) {
    WorkPost post{.probe = message.probe()};
    read_round(message, at, post, reader);
    reader.require(message.has_top_mm(), message.top_mm(), post.top_mm, at + ".top_mm");
    return post;
}

void write_block(const WorkBlock& block, proto::WorkBlock& message) {
    message.set_x_min_mm(block.x_min_mm);
    message.set_x_max_mm(block.x_max_mm);
    message.set_y_min_mm(block.y_min_mm);
    message.set_y_max_mm(block.y_max_mm);
    message.set_top_mm(block.top_mm);
    message.set_rise_x(block.rise_x);
    message.set_rise_y(block.rise_y);
    message.set_wave_mm(block.wave_mm);
    message.set_wave_length_mm(block.wave_length_mm);
    for (const WorkBore& bore : block.bores) { write_round(bore, *message.add_bore()); }
    message.set_angle_deg(block.angle_deg);
    message.set_probe(block.probe);
}

void write_post(const WorkPost& post, proto::WorkPost& message) {
    write_round(post, message);
    message.set_top_mm(post.top_mm);
    message.set_probe(post.probe);
}

}  // namespace

WorkpieceConfig read_workpiece(const proto::Workpiece& message, ProtoReader reader) {
    WorkpieceConfig work{
        .tip_mm = message.tip_mm(), .tip_length_mm = message.tip_length_mm(), .blocks = {}, .posts = {}};
    for (int k = 0; k < message.block_size(); ++k) {
        work.blocks.push_back(read_block(message.block(k), fmt::format("workpiece.block[{}]", k), reader));
    }
    for (int k = 0; k < message.post_size(); ++k) {
        work.posts.push_back(read_post(message.post(k), fmt::format("workpiece.post[{}]", k), reader));
    }
    return work;
}

void write_workpiece(const WorkpieceConfig& work, proto::Workpiece& message) {
    message.set_tip_mm(work.tip_mm);
    message.set_tip_length_mm(work.tip_length_mm);
    for (const WorkBlock& block : work.blocks) { write_block(block, *message.add_block()); }
    for (const WorkPost& post : work.posts) { write_post(post, *message.add_post()); }
}

}  // namespace lockstep
