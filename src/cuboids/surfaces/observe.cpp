// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "cuboids/objects/tints.h"
#include "cuboids/surfaces/depth_noise.h"
#include "cuboids/surfaces/observation.h"
#include "cuboids/surfaces/supports.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kLeastUnmasked = 0.02;  // of the points, on flat regions that no mask names
constexpr double kSupportSigmas = 3.0;
constexpr double kFarthest = 100.0;       // m; nothing measures depth so far indoors: wrong units
constexpr std::size_t kFewestDepths = 200;
constexpr int kFewestSupportPoints = 60;
constexpr double kFirstWidth = 3.0;  // σ, of a piece of support that has a normal of its own; objects have no room for it
const double kFlatCosine = std::cos(radians(35.0));
const double kSameUp = std::cos(radians(5.0)), kNearVertical = std::cos(radians(5.0));
const double kMostSlope = std::cos(radians(30.0));  // of a ramp that stands for the ground

void check_frame(const RgbdFrame& frame) {
  if (frame.is_fused()) {
    if (frame.cloud.positions.size() < kFewestDepths)
      throw InputError(frame.name, "cloud", fmt::format("{} points", frame.cloud.size()),
                       fmt::format("at least {}", kFewestDepths));
    return;
  }
  const Camera& c = frame.camera;
  const std::size_t pixels = static_cast<std::size_t>(c.width) * std::max(c.height, 0);
  if (frame.depth.empty()) throw InputError(frame.name, "depth", "nothing", "a depth image or a cloud");
  if (frame.depth.size() != pixels)
    throw InputError(frame.name, "depth", fmt::format("{} pixels", frame.depth.size()),
                     fmt::format("{} × {} of them", c.width, c.height));
  if (!(c.fx > 0.0 && c.fy > 0.0) || !std::isfinite(c.cx) || !std::isfinite(c.cy))
    throw InputError(frame.name, "camera", fmt::format("focal lengths {} and {}", c.fx, c.fy), "positive focal lengths");
  if (!frame.color.empty() && frame.color.size() != pixels)
    throw InputError(frame.name, "color", fmt::format("{} pixels", frame.color.size()), "as many as the depth image");
  if (!frame.masks.empty() && frame.masks.size() != pixels)
    throw InputError(frame.name, "masks", fmt::format("{} pixels", frame.masks.size()), "as many as the depth image");
}

void check_points(const RgbdFrame& frame, const Measured& measured) {
  const char* field = frame.is_fused() ? "cloud" : "depth";
  if (measured.points.size() < kFewestDepths)
    throw InputError(frame.name, field, fmt::format("{} valid measurements", measured.points.size()),
                     fmt::format("at least {}", kFewestDepths));
  std::vector<double> depth;
  for (std::size_t i = 0; i < measured.points.size(); i += 11) depth.push_back(measured.points[i].norm());
  const double middle = median(std::move(depth));
  if (middle > kFarthest)
    throw InputError(frame.name, field, fmt::format("a median distance of {:.0f} m", middle),
                     "metres after division by depth_scale");
}

/// Supports that the frame file names, each with the points that lie on it.
FoundSupports given_supports(const RgbdFrame& frame, const Scan& scan) {
  FoundSupports found;
  for (const GivenSupport& given : frame.supports) {
    Support support;
    const double length = given.plane.normal.norm();
    if (!(length > 0.0) || !std::isfinite(given.plane.offset))
      throw InputError(frame.name, "supports", "a plane without direction", "normal and offset of a plane");
    support.plane = {given.plane.normal / length, given.plane.offset / length};
    if (support.plane.offset > 0.0) support.plane = {-support.plane.normal, -support.plane.offset};
    const auto kind = std::find(std::begin(kSupportKinds), std::end(kSupportKinds), given.kind);
    if (kind == std::end(kSupportKinds))
      throw InputError(frame.name, "supports", given.kind, "ground, desk, wall or ceiling");
    support.kind = static_cast<SupportKind>(kind - std::begin(kSupportKinds));
    found.supports.push_back(support);
  }
  std::stable_sort(found.supports.begin(), found.supports.end(),
                   [](const Support& a, const Support& b) { return a.kind < b.kind; });
  if (found.supports.front().kind > SupportKind::desk)
    throw InputError(frame.name, "supports", "no ground", "one that is ground or desk");
  found.up = found.supports.front().plane.normal;
  for (std::size_t s = 0; s < found.supports.size(); ++s) {
    found.supports[s].id = static_cast<int>(s);
    found.points.emplace_back();
    for (std::size_t f = 0; f < scan.faces.faces.size(); ++f) {
      const Face& face = scan.faces.faces[f];
      if (face.plane.normal.dot(found.supports[s].plane.normal) > kFlatCosine &&
          std::abs(found.supports[s].plane.signed_distance(face.center)) <
              kSupportSigmas * scan.graph.sigma[face.points.front()] + 0.003)
        found.points.back().insert(found.points.back().end(), face.points.begin(), face.points.end());
    }
  }
  return found;
}

/// z up, z = 0 on the ground, origin below the camera; the camera's forward on +y, or what is up in its picture.
/// A cloud has no camera; its own y, or z where y is up, takes the place of forward.
RigidTransform world_of(const Vec3& up, const Plane& ground, bool is_image) {
  Vec3 forward = is_image ? Vec3::UnitZ() : Vec3::UnitY();
  if (std::abs(forward.dot(up)) > kNearVertical) forward = is_image ? Vec3(-Vec3::UnitY()) : Vec3::UnitZ();
  RigidTransform T;
  const Vec3 y = (forward - forward.dot(up) * up).normalized();
  T.rotation.row(0) = y.cross(up);
  T.rotation.row(1) = y;
  T.rotation.row(2) = up;
  // The ground's height right below the viewpoint.
  T.translation = {0, 0, -ground.offset / ground.normal.dot(up)};
  return T;
}

/// The faces of a support belong to it, and single points that lie on it; the feet of what stands on it do not, nor flat things that
/// a mask names.
std::vector<int> assign(const FoundSupports& found, const Scan& scan, const std::vector<char>& is_named) {
  std::vector<int> support(scan.points.size(), -1);
  for (std::size_t s = 0; s < found.supports.size(); ++s)
    for (const int i : found.points[s]) support[i] = static_cast<int>(s);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3& p = scan.points[i];
    for (std::size_t s = 0; s < found.supports.size(); ++s) {
      const Plane& plane = found.supports[s].plane;
      const double slant = std::abs(plane.normal.dot(p)) / (scan.is_image ? p.z() : p.norm());
      const double reach = kSupportSigmas * scan.graph.sigma[i] * std::clamp(slant, 0.3, 1.0);
      const double distance = std::abs(plane.signed_distance(p)), turned = plane.normal.dot(scan.graph.normals[i]);
      const bool on = distance < 0.5 * reach || (!is_named[i] && distance < 1.5 * reach && turned > kFlatCosine);
      if (support[i] < 0 && on) support[i] = static_cast<int>(s);
      if (support[i] == static_cast<int>(s) && distance > 5.0 * reach + 0.003) support[i] = -1;
    }
  }
  return support;
}

/// Flat regions that may be supports.
struct SupportFaces {
  Faces faces;
  bool unnamed = false;  ///< they are what no mask names; false also if that is next to nothing
};

SupportFaces faces_of_supports(const RgbdFrame& frame, const Measured& measured, const PointGraph& graph) {
  std::vector<int> group(measured.points.size(), 0);
  const auto grown = [&] { return grow_faces(measured.points, graph, group, Vec3::Zero(), kFewestSupportPoints, kFirstWidth); };
  if (!frame.masks.empty() && !frame.is_fused()) {
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = frame.masks[measured.pixel_of_point[i]] > 0 ? -1 : 0;
    Faces faces = grown();
    const auto in_faces = std::count_if(faces.face_of_point.begin(), faces.face_of_point.end(), [](int f) { return f >= 0; });
    if (static_cast<double>(in_faces) > kLeastUnmasked * static_cast<double>(group.size())) return {std::move(faces), true};
    std::fill(group.begin(), group.end(), 0);
  }
  return {grown(), false};
}

/// Whether a pixel is in a mask, and not at its rim: that may lie a little off.
bool is_well_named(const RgbdFrame& frame, int pixel) {
  constexpr int kRim = 3;  // pixels
  const int u = pixel % frame.camera.width, v = pixel / frame.camera.width;
  for (const auto& [du, dv] : {std::pair{0, 0}, {-kRim, 0}, {kRim, 0}, {0, -kRim}, {0, kRim}}) {
    const int x = std::clamp(u + du, 0, frame.camera.width - 1), y = std::clamp(v + dv, 0, frame.camera.height - 1);
    if (frame.masks[static_cast<std::size_t>(y) * frame.camera.width + x] == 0) return false;
  }
  return true;
}

/// A word where up is not what most pictures have, or may be wrong.
void remark_on_up(const FoundUp& told, const Vec3& up, Context& context) {
  const bool turned = is_turned(up);
  if (!turned && !told.ambiguous) return;
  const auto shown = [](double x) { return std::round(100.0 * x) / 100.0 + 0.0; };  // never −0.00
  context.warn(fmt::format("{}: up is taken as [{:.2f}, {:.2f}, {:.2f}] from the ground; if that is wrong, give it as \"up\" in frame.json",
                           turned ? "the camera seems turned about its axis" : "more than one surface may be the ground", shown(up.x()), shown(up.y()),
                           shown(up.z())));
}

/// A word where what was given hardly goes with the picture.
void remark_on_camera(const RgbdFrame& frame, Context& context) {
  constexpr double kOblong = 1.25;  // pixels: those of nearly all cameras are square
  const double fx = frame.camera.fx, fy = frame.camera.fy;
  if (!frame.is_fused() && std::max(fx, fy) > kOblong * std::min(fx, fy))
    context.warn(fmt::format("camera: fx = {:.4g} and fy = {:.4g} make pixels oblong; if they are square, all sizes are wrong", fx, fy));
  constexpr double kOffMiddle = 0.25;  // of the picture: where no camera has its axis
  const auto is_off = [](double c, int size) { return std::abs(c - 0.5 * (size - 1)) > kOffMiddle * size; };
  if (!frame.is_fused() && (is_off(frame.camera.cx, frame.camera.width) || is_off(frame.camera.cy, frame.camera.height)))
    context.warn(fmt::format("camera: cx = {:.4g} and cy = {:.4g} are far from the middle of a picture of {} x {} pixels; unless it was cropped, everything is sheared", frame.camera.cx, frame.camera.cy,
                             frame.camera.width, frame.camera.height));
}

void remark_on_given_supports(const Observation& seen, Context& context) {
  constexpr double kHardly = 0.005;  // of the points
  for (const Support& support : seen.supports) {
    const auto on = std::count(seen.support_of_point.begin(), seen.support_of_point.end(), support.id);
    if (support.kind > SupportKind::desk || static_cast<double>(on) > kHardly * static_cast<double>(seen.points.size())) continue;
    context.warn(fmt::format("{} in the picture lies on the {} that is given; its normal and offset are those of the camera's coordinates, in metres", on > 0 ? "hardly anything" : "nothing",
                             kSupportKinds[static_cast<std::size_t>(support.kind)]));
  }
}

}  // namespace

Observation observe(const RgbdFrame& frame, const Options& options, Context& context) {
  check_frame(frame);
  remark_on_camera(frame, context);
  const Measured measured = measured_points(frame);
  check_points(frame, measured);
  Observation seen;
  seen.graph = link_points(frame, measured, depth_noise(frame, options), options.gap, context);
  context.check();
  const SupportFaces flat = faces_of_supports(frame, measured, seen.graph);
  const Scan scan{measured.points, seen.graph, flat.faces, !frame.is_fused(), measured.pixel_of_point, measured.point_of_pixel, frame.camera.width};
  context.check();

  FoundSupports found;
  if (!frame.supports.empty()) {
    found = given_supports(frame, scan);
    if (frame.up && frame.up->normalized().dot(found.up) > kSameUp) found.up = frame.up->normalized();
  } else {
    const FoundUp told = frame.up ? FoundUp{frame.up->normalized()} : find_up(scan);
    Vec3 up = told.up;
    if (!up.allFinite() || up.norm() < 0.5) throw InputError(frame.name, "depth", "no plane", "a surface to stand on in the picture (or --support)");
    found = find_supports(scan, up, flat.unnamed);
    if (frame.up && found.upside_down)
      throw InputError(frame.name, "up", "a direction that only undersides face", "the direction against gravity, and a surface to stand on in the picture (or --support)");
    if (frame.up && found.supports.empty())
      if (const Vec3 slope = find_up(scan).up; slope.dot(up) > kMostSlope) {
        context.warn(fmt::format("no plane is orthogonal to the given up: what leans by {:.0f}° is taken for the ground, and its normal for up", degrees(line_angle(slope, up))));
        up = slope;
        found = find_supports(scan, up, flat.unnamed);
      }
    if (found.supports.empty())
      throw InputError(frame.name, "depth", "no horizontal plane", "a surface to stand on that no mask names, in the picture or by --support");
    if (frame.up && found.up.dot(up) < kSameUp) found.up = up;
    if (!frame.up && scan.is_image) remark_on_up(told, found.up, context);
  }
  seen.T_world_camera = world_of(found.up, found.supports.front().plane, scan.is_image);
  std::vector<char> is_named(scan.points.size(), 0);
  if (flat.unnamed)
    for (std::size_t i = 0; i < is_named.size(); ++i) is_named[i] = is_well_named(frame, measured.pixel_of_point[i]);
  seen.support_of_point = assign(found, scan, is_named);
  const RigidTransform& T = seen.T_world_camera;
  seen.supports = found.supports;
  for (Support& support : seen.supports) {
    support.plane.offset += (T.rotation * support.plane.normal).dot(T.translation);
    support.plane.normal = T.rotation * support.plane.normal;
    for (Vec3& p : support.outline) p = T * p;
  }
  seen.points.reserve(measured.points.size());
  for (const Vec3& p : measured.points) seen.points.push_back(T * p);
  for (Vec3& n : seen.graph.normals) n = T.rotation * n;
  seen.pixel_of_point = measured.pixel_of_point;
  seen.point_of_pixel = measured.point_of_pixel;
  seen.tints = tints_of(frame);
  if (!frame.supports.empty()) remark_on_given_supports(seen, context);
  return seen;
}

}  // namespace unseen::cuboids
