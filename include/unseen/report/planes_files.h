// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/planes/types.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {

/// planes.ply: the polygons as triangles, each with its plane, frame and colour, vertices coloured, too; 2D:
/// line segments as edges.
std::string planes_ply(const planes::Arrangement& arrangement);

/// planes.obj: one object and group a plane, one material a frame from `material_file`; 2D: line elements.
std::string planes_obj(const planes::Arrangement& arrangement, const std::string& material_file);

/// The materials that planes_obj refers to.
std::string planes_mtl(const planes::Arrangement& arrangement);

/// scene.glb (binary glTF 2.0): a node a plane, "plane 12 (wall)", coloured by frame, and a node "points".
/// The root node turns z up into glTF's y up. Coordinates far from the origin (UTM) are stored relative to an
/// offset, which stands in the root node's extras as "offset": world = stored + offset.
std::string planes_glb(const planes::Arrangement& arrangement, const PointSample& points);

/// scene.usda (USD ASCII): a Mesh a plane, /unseen/planes/frame_0/plane_12, 2D: a linear BasisCurves, with
/// the frame's colour, and at most 50 000 points, coloured by plane. Metres, z up. Far coordinates are stored
/// like those of planes_glb; the offset is the translation of /unseen.
std::string planes_usda(const planes::Arrangement& arrangement, const PointSample& points);

/// planes.csv (RFC 4180): the as-built table, a row a plane, units in the header (docs/formats.md).
std::string planes_csv(const planes::Arrangement& arrangement);

/// drawing.dxf (R12, ASCII): a LINE a segment of a 2D arrangement, a layer a frame; world coordinates,
/// metres.
std::string drawing_dxf(const planes::Arrangement& arrangement);

/// drawing.svg: the segments of a 2D arrangement in true size, one user unit a metre, a group a frame. Far
/// coordinates are stored like those of planes_glb; <desc> says how to get back to the world.
std::string drawing_svg(const planes::Arrangement& arrangement);

/// "plane 12 (wall)", or "plane 12" if it has no tag.
std::string plane_name(const planes::Arrangement& arrangement, std::size_t plane);

}  // namespace unseen::report
