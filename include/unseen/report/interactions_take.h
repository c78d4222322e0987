// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>

#include "unseen/interactions/types.h"

namespace unseen::report {

/// Reads a TAKE.json with the files it names; paths are relative to its folder.
///
///   {"camera": {"fx","fy","cx","cy","width","height"} | {"hfov_deg","width","height"},   absent: 60° across; "assumed": true is allowed in it
///    "fps": 30,                          30 if absent
///    "joints": FILE | FOLDER,            required
///    "format": "openpose"|"coco"|"mediapipe"|"i3db",   required
///    "people": 1,                        how many there are
///    "lifted": FILE,                     initial 3D poses: {"frames": [{"frame": n, "people": [[[x,y,z] × 16] | null, …]}, …]}, m, camera axes,
///                                        people in the order of the frame's detections in "joints"
///    "up": [x,y,z],                      camera coordinates, any length
///    "camera_height": 1.4,               m above the floor
///    "labels": [{"frame","person","pixel": [u,v]}, …],   whoever is at this pixel has this number, 0 … people − 1
///    "masks": [{"category","image"}, …]} pictures of the camera's size; not black = inside
///
/// Formats:
/// - openpose: a folder with a JSON file a frame (BODY_25 or COCO-18, several people); the last number in a file's name is its frame.
/// - coco: one file, {"annotations": […]} or a list, of {"image_id", "keypoints": 17 × (x, y, c)}; c is 0, 1, 2 (2 = visible) in all
///   of the file, or a confidence in [0,1]. "image_id" is the frame; of a text, the last number in it.
/// - mediapipe: one file, a list of frames (or {"frames": […]}), each {"frame"?, "landmarks", "world_landmarks"?} or the landmarks
///   alone: 33 × {"x","y","z","visibility"} (or [x,y,z,visibility]) of one person, or a list of such, or null. x and y are shares of
///   the picture's width and height, world landmarks m.
/// - i3db: a scene folder, skel_NAME_2d_00.json (one a person, sorted by name) and, if there, skel_NAME_unannot.json.
///
/// Pelvis, thorax and neck that a format lacks lie between their neighbours, with the lowest confidence of them; head is the nose.
/// What was odd but could be read stands in Take::remarks: guessed picture size, frames out of order, the same detection twice, joints
/// outside the picture. Throws InputError (file, field, found, expected), also for fields that it does not know.
interactions::Take read_take(const std::filesystem::path& path);

}  // namespace unseen::report
