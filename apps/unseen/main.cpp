// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cstdio>

#include "unseen/core/version.h"

int main() { std::printf("unseen %s\n", unseen::kVersion); }
