// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

namespace unseen {

/// One visitor from several lambdas.
template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

}  // namespace unseen
