// The one list of settings. It gives the struct, range checks, the command line, the panel with its tooltips
// and the JSON stored beside results. Add a setting here and nowhere else.
//
// INT(name, default, min, max, group, effect, help)      REAL(...) likewise, float
// BOOL(name, default, group, effect, help)               CHOICE(Enum, name, default, group, effect, help)
// VEC3(name, x, y, z, min, max, group, effect, help)     COLOR(...) likewise, linear RGB
// effect: NONE, IMAGE (the picture's history restarts), TARGETS (as IMAGE, and textures are made anew)
#pragma once

#define TARN_SETTINGS(INT, REAL, BOOL, CHOICE, VEC3, COLOR)                                                  \
    REAL(                                                                                                    \
        tradeoff, 0.5, 0, 1, TRADE, NONE,                                                                    \
        "Speed (0) or accuracy (1): the nearest point of the measured front, which sets what is below. The " \
        "qualities are points of it or near.")                                                               \
    BOOL(governor, false, TRADE, NONE,                                                                       \
         "Move tradeoff by itself so that frames take frame_time_target_ms, in the window.")                 \
    REAL(frame_time_target_ms, 33, 1, 10000, TRADE, NONE, "The time of a frame that the governor holds.")    \
    REAL(ticks_per_second, 30, 1, 1000, SIMULATION, NONE, "Simulation ticks per second of play.")            \
    INT(ticks_per_frame, 0, 0, 1000, SIMULATION, NONE,                                                       \
        "Ticks before each frame; 0: by the clock in the window, none headless.")                            \
    CHOICE(WaterTier, water_tier, Level, SIMULATION, NONE,                                                   \
           "Rule of the water: block (fastest, slow to level), level (finds its level and rests), pressure " \
           "(also rises in communicating vessels).")                                                         \
    INT(film_threshold, 3, 1, 16, SIMULATION, NONE,                                                          \
        "Quanta (sixteenths of a voxel) of water per cell that stay as a film instead of spreading.")        \
    INT(water_substeps, 1, 1, 8, SIMULATION, NONE,                                                           \
        "Steps of water and sand in a tick: more flow and level faster, at as many times the cost. Springs " \
        "and drains keep to ticks.")                                                                         \
    INT(pressure_sweeps, 1, 1, 16, SIMULATION, NONE,                                                         \
        "Sweeps of the head in each step under pressure: more let it reach through vessels sooner.")         \
    CHOICE(Quality, quality, Balanced, LIGHT, NONE, "Preset of the settings below, from fast to exact.")     \
    INT(max_bounces, 24, 0, 1024, LIGHT, IMAGE,                                                              \
        "Scatterings along a path before it ends (refraction counts).")                                      \
    INT(max_diffuse_bounces, 2, 0, 1024, LIGHT, IMAGE,                                                       \
        "Of these, scatterings at rough surfaces: clear water may need many bounces where diffuse light "    \
        "needs few.")                                                                                        \
    REAL(max_distance_vox, 4096, 1, 10000000, LIGHT, IMAGE, "Longest ray in voxels; beyond it is sky.")      \
    INT(samples_per_pixel, 1, 1, 64, LIGHT, IMAGE, "Paths per pixel in each frame.")                         \
    INT(new_pixel_samples, 1, 1, 16, LIGHT, NONE,                                                            \
        "Paths in place of each one, of a pixel of fewer than 4 samples so far, where history is count.")    \
    REAL(resolution_scale, 1, 0.25, 1, LIGHT, TARGETS, "Traced pixels per shown pixel, along each side.")    \
    BOOL(guided_upsampling, true, LIGHT, IMAGE,                                                              \
         "Where fewer pixels are traced than shown: spread their light within the surfaces of the shown "    \
         "ones; off: blend them, bright ones less.")                                                         \
    CHOICE(Traversal, traversal, Distance, LIGHT, IMAGE,                                                     \
           "voxel: step through every voxel; distance: skip empty bricks. Same picture.")                    \
    CHOICE(                                                                                                  \
        LightSampling, light_sampling, Lights, LIGHT, IMAGE,                                                 \
        "Light sampled at every scattering: none (found by chance), lights (the sun and emissive voxels), "  \
        "or all (the sky too).")                                                                             \
    CHOICE(DiffuseSampling, diffuse_sampling, Cosine, LIGHT, IMAGE,                                          \
           "Diffuse directions: by their cosine, or uniform over the hemisphere (more noise).")              \
    BOOL(low_discrepancy, true, LIGHT, IMAGE,                                                                \
         "Spread the random numbers of a pixel's frames evenly: less noise once frames are averaged; off: "  \
         "independent numbers.")                                                                             \
    BOOL(sun_through_water, true, LIGHT, IMAGE,                                                              \
         "Connect points under smooth water to the sun through the surface, in closed form.")                \
    BOOL(                                                                                                    \
        smooth_water, true, LIGHT, IMAGE,                                                                    \
        "Shade neighbouring voxels that hold different amounts of water as one smooth surface; off: as the " \
        "steps they are.")                                                                                   \
    BOOL(straight_sunlight, true, LIGHT, IMAGE,                                                              \
         "Let sunlight pass straight through water and glass to what lies in air behind: wrong in "          \
         "direction, but "                                                                                   \
         "without it such shadows are black unless caustics fill them.")                                     \
    BOOL(caustics, false, LIGHT, IMAGE,                                                                      \
         "Keep sunlight found by chance after mirrors and glass: right in the limit, sparkles before it.")   \
    INT(roulette_after, 3, 0, 1024, LIGHT, IMAGE, "Bounces before Russian roulette; 1024: none.")            \
    BOOL(                                                                                                    \
        jitter, false, LIGHT, IMAGE,                                                                         \
        "Spread samples over the pixel: smooth edges once averaged. For exact; other histories blur by it.") \
    REAL(firefly_limit, 4, 0, 1000000, LIGHT, IMAGE,                                                         \
         "Upper limit of one sample's radiance after the first bounce; 0: none. Darkens rare bright paths.") \
    CHOICE(                                                                                                  \
        History, history, Count, IMAGE_FILTER, TARGETS,                                                      \
        "Reuse of earlier frames: none, blend (constant weight), count (running mean), exact (all frames).") \
    REAL(history_alpha, 0.1, 0.001, 1, IMAGE_FILTER, IMAGE,                                                  \
         "Weight of the new frame where history is blend.")                                                  \
    INT(history_cap, 48, 1, 4096, IMAGE_FILTER, IMAGE,                                                       \
        "Most frames kept where history is count, 12 in flight.")                                            \
    BOOL(retrace_changes, true, IMAGE_FILTER, IMAGE,                                                         \
         "After a change of the world trace a ninth of the last frame's paths again, a quarter after an "    \
         "edit, where history is count, "                                                                    \
         "and keep less of it where their light changed: shadows and images in water follow.")               \
    BOOL(refine_at_rest, true, IMAGE_FILTER, IMAGE,                                                          \
         "While eye and world rest, add frames of quality exact and let the picture glide into their mean.") \
    CHOICE(Filter, filter, EdgeAware, IMAGE_FILTER, TARGETS,                                                 \
           "Blur against noise: none, gaussian, or edge_aware (within one surface; of new pixels, stairs).") \
    INT(filter_passes, 1, 1, 5, IMAGE_FILTER, IMAGE,                                                         \
        "Passes of the filter, each twice as wide as the last.")                                             \
    INT(antialiasing, 4, 0, 8, IMAGE_FILTER, TARGETS,                                                        \
        "Places in each pixel at which edges are looked for, without more rays, an even number; 0: none. "   \
        "Not with jitter "                                                                                   \
        "or the history exact, which need none.")                                                            \
    VEC3(camera_position_vox, 0, 0, 0, -10000000, 10000000, CAMERA, NONE, "Position of the eye in voxels.")  \
    REAL(camera_yaw_deg, 0, -360, 360, CAMERA, NONE, "Heading: 0 looks along -z and grows to the right.")    \
    REAL(camera_pitch_deg, 0, -90, 90, CAMERA, NONE, "Elevation of the view; grows upward.")                 \
    REAL(camera_fov_deg, 60, 1, 179, CAMERA, NONE, "Vertical field of view.")                                \
    REAL(water_ior, 1.333, 0.75, 3, WATER, IMAGE, "Refractive index of water.")                              \
    COLOR(water_color, 0.7, 0.93, 0.96, 0.0001, 1, WATER, IMAGE,                                             \
          "Colour of white light after one metre of water.")                                                 \
    CHOICE(SkyModel, sky_model, Gradient, SKY, IMAGE,                                                        \
           "gradient: two colours and a sun, as set below; preetham: the light of a clear sky and its sun, " \
           "computed from the sun's height and the haze.")                                                   \
    REAL(turbidity, 2.5, 2, 10, SKY, IMAGE, "Haze of the sky preetham: 2 very clear, 10 hazy.")              \
    REAL(sky_brightness, 1, 0, 1000, SKY, IMAGE, "Factor on the light of the sky preetham and its sun.")     \
    REAL(time_of_day_h, 12, 0, 24, SKY, NONE,                                                                \
         "Places the sun by the hour of 21 June at 50 degrees north, where noon is at 12 and -z is north; "  \
         "azimuth and elevation can be moved afterwards. The colours of the sky follow in preetham alone.")  \
    REAL(sun_azimuth_deg, 0, -360, 360, SKY, IMAGE, "Where the sun stands, as a camera's yaw.")              \
    REAL(sun_elevation_deg, 45, -90, 90, SKY, IMAGE, "Height of the sun, as a camera's pitch.")              \
    COLOR(sun_irradiance, 4, 3.6, 3, 0, 1000000, SKY, IMAGE,                                                 \
          "Sunlight of the gradient on a surface that faces it; black: no sun.")                             \
    REAL(sun_angular_radius_deg, 0.27, 0, 90, SKY, IMAGE, "Angular radius of the sun; 0: sharp shadows.")    \
    COLOR(sky_zenith, 0.12, 0.28, 0.7, 0, 1000000, SKY, IMAGE, "Radiance of the gradient overhead.")         \
    COLOR(sky_horizon, 0.5, 0.68, 0.95, 0, 1000000, SKY, IMAGE,                                              \
          "Radiance of the gradient at and below the horizon.")                                              \
    REAL(exposure_ev, 0, -20, 20, DISPLAY, NONE, "Exposure in stops.")                                       \
    CHOICE(ToneMap, tone_map, Filmic, DISPLAY, NONE, "filmic: soft highlights; linear: clipped at white.")   \
    CHOICE(ViewKind, view, Picture, DISPLAY, NONE,                                                           \
           "What is shown (V). Of the first surface: albedo, normal, depth, material. Of the last frame's "  \
           "paths: bounces and steps through the world, rays to the sun included. Of what is averaged: "     \
           "history (frames kept) and variance (of the mean's luminance, before the filter).")               \
    BOOL(overlay, true, DISPLAY, NONE, "Show times, ticks and counts in a corner.")                          \
    BOOL(vsync, true, DISPLAY, NONE, "Wait for the display between frames.")                                 \
    REAL(fly_speed_vox_s, 24, 0.1, 10000, DISPLAY, NONE,                                                     \
         "Flying speed in voxels per second; Shift: four times.")                                            \
    BOOL(fly_through_ground, false, DISPLAY, NONE, "Fly through solid voxels; off: slide along them.")       \
    REAL(mouse_sensitivity, 0.15, 0.01, 5, DISPLAY, NONE, "Degrees of turn per pixel of mouse movement.")
