#pragma once
// facet renders scenes with physically based materials on any Vulkan device, and on the CPU.
//
//     auto scene = facet::load_scene("cbox.xml");
//     auto backend = facet::open_backend();
//     auto film = backend->render(scene, {.samples = 64});
//     facet::write_image("cbox.exr", film);
//
// Whatever goes wrong is a facet::Error. Scenes and images may be used by several threads at a
// time, a backend by one.
#include <facet/backend.h>
#include <facet/checkpoint.h>
#include <facet/error.h>
#include <facet/film.h>
#include <facet/images.h>
#include <facet/request.h>
#include <facet/scene.h>
