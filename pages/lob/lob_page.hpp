#pragma once

#include "pages/lob/scene.hpp"
#include "pages/serve/page.hpp"

namespace trivela::pages {

/// The page of lobs: /, /api/state, /api/frame?i=N, /api/table.csv and the scene's commands. The scene must outlive it.
Page lob_page(Scene& scene);

}  // namespace trivela::pages
