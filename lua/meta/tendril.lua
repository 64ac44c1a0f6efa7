---@meta tendril
-- Written by `tendril --annotations`: do not edit. For editors that speak to the Lua language server.

---A vector or point, immutable. Wherever a vec is expected a plain {x, y, z} will do
---@class vec
---@field x number First component
---@field y number Second component
---@field z number Third component
---@operator add(vec|number[]): vec
---@operator sub(vec|number[]): vec
---@operator mul(number|vec|number[]): vec
---@operator div(number): vec
---@operator unm: vec
local vec_methods = {}

---Vector product.
---@param other vec|number[]
---@return vec
function vec_methods:cross(other) end

---Scalar product.
---@param other vec|number[]
---@return number
function vec_methods:dot(other) end

---Euclidean length.
---@return number
function vec_methods:length() end

---The vector of length 1 in the same direction; an error for the zero vector.
---@return vec
function vec_methods:unit() end

---A place and orientation of a rod's section: d3 is the rod's tangent, d1 and d2 its own axes
---@class frame
---@field along vec Direction of d3, a unit vector
---@field at vec Place (m)
---@field up vec Direction of d1, a unit vector
local frame_methods = {}

---@class (exact) tendril.frame.moved.options
---@field by? vec|number[] Displacement in world axes (m)
---@field turn? [vec|number[], number] {axis, angle}: turn about the world axis `axis` through the frame's own place (rad)

---A new frame, displaced and turned.
---@param options? tendril.frame.moved.options
---@return frame
function frame_methods:moved(options) end

---An isotropic linear-elastic material
---@class material
---@field density number Mass per volume (kg/m^3)
---@field shear number Shear modulus (Pa)
---@field young number Young's modulus (Pa)
local material_methods = {}

---A cross-section: its size, stiffnesses and mass
---@class section
---@field EA number Stretch stiffness (N)
---@field EI1 number Bending stiffness about d1 (N m^2)
---@field EI2 number Bending stiffness about d2 (N m^2)
---@field GA1 number Shear stiffness along d1 (N)
---@field GA2 number Shear stiffness along d2 (N)
---@field GJ number Twist stiffness (N m^2)
---@field inner number Inner diameter (m)
---@field mass number Mass per length (kg/m)
---@field material material? What it is made of; nil where the stiffnesses were measured
---@field outer number Outer diameter (m)
local section_methods = {}

---The design of a cable or hose; it never changes
---@class rod
---@field length number Unstressed (m)
---@field mass number All of it (kg)
---@field section section Cross-section, the first when there are several
---@field sections ({upto: number, [1]: section})[] List of {upto =, section} along the rod
---@field segments integer Elements
---@field shape curve? Unstressed shape; nil when straight
local rod_methods = {}

---The section at an arc length in m.
---@param s number
---@return section
function rod_methods:section_at(s) end

---@class (exact) tendril.rod.with.options
---@field section? section|({upto: number, [1]: section})[] Cross-section, or a list of {upto = s, section} along the rod
---@field length? number Unstressed length; that of the curve when there is a shape (m; > 0)
---@field shape? curve Unstressed shape of a preformed rod; default straight
---@field segments? integer Elements along the rod (1 ... 1000000)

---A changed copy; this one stays as it is.
---@param options? tendril.rod.with.options
---@return rod
function rod_methods:with(options) end

---An insulated wire, for bundles
---@class wire
---@field area number Metal in the conductor (m^2)
---@field conductor number Diameter of the circle around the conductor's strands (m)
---@field insulation_young number Of the insulation (Pa)
---@field mass number Mass per length (kg/m)
---@field min_bend_radius number Of its centre line; 0: not stated (m)
---@field outer number Outside diameter, with insulation (m)
---@field strands integer In the conductor
---@field young number Of the conductor's metal (Pa)
local wire_methods = {}

---How the section of a bundle came about
---@class bundle
---@field EI_range (number)[] {wires and strands slip freely, all glued} (N m^2)
---@field GJ_range (number)[] {wires and strands slip freely, all glued} (N m^2)
---@field min_bend_radius number Of the bundle's centre line, so that no wire inside bends below its own; 0: none stated (m)
---@field outer number Outside diameter, with tape (m)
---@field section section For rod.new
---@field slip number That was used: 1 slips freely, 0 glued
local bundle_methods = {}

---A curve in space by arc length; it never changes
---@class curve
---@field kind string "polyline", "pcc", "spline" or "helix"
---@field length number Arc length (m)
---@field points (vec)[] Those it was made from; a helix: its ends (m)
local curve_methods = {}

---Place and orientation at an arc length in m; along is the tangent.
---@param s number
---@return frame
function curve_methods:at(s) end

---The smallest bend radius in m, and where; 0 at a polyline's corner, math.huge when straight.
---@return any
function curve_methods:min_bend_radius() end

---A rod in a scene: hold it, load it
---@class placed_rod
---@field design rod What it is
---@field name string Its name in the scene
local placed_rod_methods = {}

---@class (exact) tendril.placed_rod.clip.options
---@field kind? "fixed"|"swivel"|"slide" What it holds: everything, the position only, or everything but sliding along d3 (default "fixed")
---@field turns? number Extra full turns about the tangent relative to the start (default 0)

---A clip at "start", "finish" or an arc length in m. Through a slide clip the rod slips without friction along d3: the arc length is where the search begins, and the equilibrium tells where it settles.
---@param where string|number
---@param frame frame
---@param options? tendril.placed_rod.clip.options
---@return placed_rod
function placed_rod_methods:clip(where, frame, options) end

---@class (exact) tendril.placed_rod.hold.options
---@field position? boolean The place is held (default true)
---@field orientation? boolean The orientation is held (default true)
---@field turns? number Extra full turns about the tangent relative to the start (default 0)

---Holds the section at "start", "finish" or an arc length in m. At a place that is held already the two holds must agree in what both fix; then the new one stands.
---@param where string|number
---@param frame frame
---@param options? tendril.placed_rod.hold.options
---@return placed_rod
function placed_rod_methods:hold(where, frame, options) end

---@class (exact) tendril.placed_rod.load.options
---@field force? vec|number[] Dead force, world axes (N)
---@field moment? vec|number[] Dead moment, world axes (N m)

---Adds a dead load (constant in world axes) at "start", "finish" or an arc length in m.
---@param where string|number
---@param options? tendril.placed_rod.load.options
---@return placed_rod
function placed_rod_methods:load(where, options) end

---Removes the hold at a place.
---@param where string|number
---@return placed_rod
function placed_rod_methods:release(where) end

---Removes all its loads.
---@return placed_rod
function placed_rod_methods:unload() end

---One part of the model, used or left out
---@class explained_item
---@field name string What it is
---@field subject string A rod's name, or 'scene'
---@field used boolean False: left out
---@field why string The reason
local explained_item_methods = {}

---What a solve does and what it leaves out
---@class explanation
---@field [integer] any
---@operator len: integer
local explanation_methods = {}

---True when some rod or the scene uses this: "gravity", "contact" ...
---@param name string
---@return boolean
function explanation_methods:uses(name) end

---The world: gravity, obstacles, robots, rods and branch points
---@class scene
---@field branches (string)[] Names of the branch points
---@field gravity vec Acceleration (m/s^2)
---@field obstacles (string)[] Names of the obstacles
---@field robots (string)[] Names of the robots
---@field rods (string)[] Names of the rods
local scene_methods = {}

---@class (exact) tendril.scene.attach.options
---@field kind? "clamp"|"swivel"|"slide" What it holds: everything, the position only, or everything but sliding along d3 (default "clamp")
---@field orientation? boolean False: the position only, as a swivel (default true)
---@field turns? number Extra full turns about the tangent relative to the start (default 0)

---Fastens a rod at "start", "finish" or an arc length in m to a robot's link; the frame is in the link's axes. The hold goes with the link. Over four radii from there the rod is not compared with that link.
---@param rod string
---@param where string|number
---@param robot string
---@param link string
---@param frame frame
---@param options? tendril.scene.attach.options
---@return placed_rod
function scene_methods:attach(rod, where, robot, link, frame, options) end

---@class (exact) tendril.scene.branch.options
---@field frame? frame Where the branch point is held, fully; default: free, it finds its place

---Joins sections of rods, {rod, place} each, to one rigid body. Their relative frames are kept from where the rods are held there now, and the branch point takes those holds' place; a third entry gives a section's frame seen from the branch point instead.
---@param name string
---@param places ([string, string|number, frame]|[string, string|number])[]
---@param options? tendril.scene.branch.options
---@return placed_branch
function scene_methods:branch(name, places, options) end

---@class (exact) tendril.scene.explain.options
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)

---Which terms, contacts and solvers this scene uses, and what was left out.
---@param options? tendril.scene.explain.options
---@return explanation
function scene_methods:explain(options) end

---@class (exact) tendril.scene.export.options
---@field equilibrium? equilibrium Where the rods are; the surroundings are then those it was solved in
---@field rods? boolean Rods as tubes (default true)
---@field obstacles? boolean Obstacles (default true)
---@field robots? boolean The robots' links (default true)
---@field tolerance? number Of the tubes' facets from the round, bent rods; default: 2 % of each rod's radius (m; > 0)
---@field unit? "mm"|"cm"|"m"|"in" Length unit of the file; default "m". A .glb is always in m

---Writes rods, obstacles and links as .glb (a named part each, in colours), .obj (a group each), .stl or .ply (one mesh).
---@param path string
---@param options? tendril.scene.export.options
---@return saved_file
function scene_methods:export(path, options) end

---@class (exact) tendril.scene.motion.options
---@field holds? table<string, function|(frame)[]> By "rod.start", "rod.finish", "rod.0.25" (an arc length in m) or a branch point's name: a function of t = 0 ... 1 that returns a frame, or a list of frames passed evenly in t
---@field robot? string Instead of holds: the robot that moves, with all rods of the scene attached to it
---@field path? ((number)[])[] Its joint values, passed evenly in t and straight between (rad or m)
---@field steps? integer Solutions that are kept, evenly spaced in t (1 ... 1000000; default 20)
---@field largest_move? number Share of the length that a vertex may move in one step before it is halved (> 0 and <= 1; default 0.02)
---@field smallest_step? number Of t; a larger move over this is a snap-through (> 0 and <= 1; default 0.0001)
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Moves holds along paths, or a robot and what is attached to it, quasi-statically: each equilibrium starts from the one before, steps adapt, and a snap-through is reported with its place.
---@param options? tendril.scene.motion.options
---@return motion
function scene_methods:motion(options) end

---@class (exact) tendril.scene.obstacle.options
---@field unit? "mm"|"cm"|"m"|"in" Length unit of the file or data; a file must be given one
---@field pose? frame Where its own axes lie: d1, d2, d3 are its x, y, z; default: the world's
---@field clearance? number Required gap to rods: judged in reports and pictures; kept with s:solve{clearance = "push"} (m; >= 0; default 0)
---@field prefer? "neutral"|"near"|"avoid" Whether routes should keep near it or away (default "neutral")
---@field clip? boolean Rods may be fastened to it (default true)

---Adds something solid: a mesh file, {points =, triangles =}, or scene.box, .cylinder, .sphere, .plane.
---@param name string
---@param shape string|solid|mesh|{points: vec[], triangles: integer[][]}
---@param options? tendril.scene.obstacle.options
---@return scene
function scene_methods:obstacle(name, shape, options) end

---The placed rod of this name.
---@param name string
---@return placed_rod
function scene_methods:placed(name) end

---The robot of this name.
---@param name string
---@return placed_robot
function scene_methods:placed_robot(name) end

---Removes a rod, a branch point, an obstacle, or a robot that carries no rod.
---@param name string
---@return scene
function scene_methods:remove(name) end

---@class (exact) tendril.scene.robot.options
---@field at? frame Where its base stands: d1, d2, d3 are the base's x, y, z axes; default: the scene's axes
---@field joints? (number)[] Joint values; default: each as near to 0 as its limits allow (rad or m)
---@field clearance? number That rods are required to keep from its links (m; >= 0; default 0)

---Places a robot. Its links are solid, called "name.link": rods touch them and keep clear of them as of obstacles.
---@param name string
---@param robot robot
---@param options? tendril.scene.robot.options
---@return placed_robot
function scene_methods:robot(name, robot, options) end

---@class (exact) tendril.scene.rod.options
---@field from? frame Where the start is held, fully; default: free
---@field to? frame Where the finish is held, fully; default: free

---Places a rod; ends not given stay free.
---@param name string
---@param design rod
---@param options? tendril.scene.rod.options
---@return placed_rod
function scene_methods:rod(name, design, options) end

---@class (exact) tendril.scene.save.options
---@field embed? boolean Meshes stand in the file itself, not by their files' names (default false)

---Writes all that the scene holds as JSON, for scene.load. Files of meshes and robots are named relative to it where they lie near it.
---@param path string
---@param options? tendril.scene.save.options
---@return scene
function scene_methods:save(path, options) end

---@class (exact) tendril.scene.solve.options
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field from? equilibrium Start from this equilibrium of a similar scene
---@field modes? boolean Also the softest eigenmodes, and other stable equilibria for the same holds (default false)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Static equilibrium of every rod. Look at .ok: what does not converge is a result, not an error.
---@param options? tendril.scene.solve.options
---@return equilibrium
function scene_methods:solve(options) end

---Triangles over shared vertices; it never changes
---@class mesh
---@field area number Of all triangles (m^2)
---@field triangle_count integer Number of triangles
---@field triangles ((integer)[])[] Three vertex numbers each, counted from 1; a new list each time
---@field vertex_count integer Number of vertices
---@field vertices (vec)[] Places; a new list each time (m)
---@field volume number Within the mesh, when it is watertight with normals outwards (m^3)
---@field watertight boolean Every edge has exactly two triangles
local mesh_methods = {}

---Whether a point lies inside a watertight mesh.
---@param point vec|number[]
---@return boolean
function mesh_methods:contains(point) end

---@class (exact) tendril.mesh.save.options
---@field unit? "mm"|"cm"|"m"|"in" Length unit of the file; default "m". A .glb is always in m

---Writes it as .stl, .ply, .obj or .glb (in which y points up: it is turned for that); a missing folder is created.
---@param path string
---@param options? tendril.mesh.save.options
function mesh_methods:save(path, options) end

---A segment of an imported harness
---@class imported_segment
---@field EI number Bending stiffness that was taken (N m^2)
---@field EI_glued number Upper bound: nothing slips (N m^2)
---@field EI_slipping number Lower bound: every strand bends by itself (N m^2)
---@field clips integer Fixings that hold it
---@field cut_off number Of the drawn curve beyond its nodes (m)
---@field drawn_bend_radius number The smallest of the drawn line (m)
---@field left_out string Why it was left out; empty: it was not
---@field length number Of its centre line (m)
---@field mass number Of the segment (kg)
---@field min_bend_radius number Allowed by its wires and nodes; 0: not stated (m)
---@field name string What the file calls it
---@field outer number Across the bundle of its wires (m)
---@field rod string The name of its rod in the scene; empty: it was left out
---@field stated_length number What the file says; 0: nothing (m)
---@field stated_outer number From the cross-section that the file states; 0: none (m)
---@field wires (string)[] Names of the wires through it
local imported_segment_methods = {}

---How far the settled rod lies from the drawn line, at most: m, the arc length there, and the way from the drawn place to the settled one.
---@param equilibrium equilibrium
---@return number, number, vec
function imported_segment_methods:departure(equilibrium) end

---A wire or cable of an imported harness
---@class imported_wire
---@field conductor_area number Of all its cores; 0: not stated (m^2)
---@field length number Of the segments it runs through (m)
---@field mass number Per length; 0: not stated (kg/m)
---@field name string Its number in the harness, else that of its part
---@field outer number Outside diameter; 0: not stated (m)
---@field segments (string)[] Ids of the segments it runs through
---@field stated_length number What the file says; 0: nothing (m)
---@field type string As the file has it
local imported_wire_methods = {}

---What a harness file holds, and what became of it in the scene
---@class imported_harness
---@field branches integer Branch points
---@field clips integer Fixings that hold rods
---@field format string Of the file
---@field held_ends integer Ends held where they are drawn
---@field largest_length_off number The largest of them (m)
---@field median_length_off number Median of the differences between segments' lengths and what the file states (m)
---@field name string Part description or number
---@field notes (string)[] What was assumed, mended or left out
---@field segments (imported_segment)[] All of the file's, in its order
---@field wire_rods table<string, (string)[]> By wire, the names of the rods it runs through: for equilibrium:quantities
---@field wires (imported_wire)[] Wires and cables
local imported_harness_methods = {}

---Writes the .kbl file back with the settled centre curves, lengths and nodes in place of the drawn ones; the rest stays as it was, byte for byte.
---@param path string
---@param equilibrium equilibrium
function imported_harness_methods:save(path, equilibrium) end

---A box, sphere, cylinder or half-space to place with scene:obstacle
---@class solid
local solid_methods = {}

---A rigid junction of rods in a scene
---@class placed_branch
---@field name string Its name in the scene
---@field rods (string)[] Names of the rods that it joins
local placed_branch_methods = {}

---@class (exact) tendril.placed_branch.hold.options
---@field position? boolean The place is held (default true)
---@field orientation? boolean The orientation is held (default true)

---Holds it in place, in orientation or both.
---@param frame frame
---@param options? tendril.placed_branch.hold.options
---@return placed_branch
function placed_branch_methods:hold(frame, options) end

---Lets it find its own place.
---@return placed_branch
function placed_branch_methods:release() end

---The smallest gap; computes as a number in m, negative where surfaces penetrate
---@class clearance
---@field at vec The place on the rod's centre line (m)
---@field ok boolean At least the required clearance; where none is required, no penetration beyond that of contact
---@field on string? Name of the obstacle, nil without one
---@field point vec The closest point of the obstacle (m)
---@field required number The clearance required of that obstacle (m)
---@field s number Arc length of the place on the rod (m)
---@field value number The gap as a plain number (m)
---@operator add(number|clearance): number
---@operator sub(number|clearance): number
---@operator mul(number|clearance): number
---@operator div(number|clearance): number
---@operator unm: number
local clearance_methods = {}

---Estimated discretisation error of the centre line; computes as a number in m
---@class error_estimate
---@field order number Observed order of convergence
---@field valid boolean False: too coarse to be trusted; see why
---@field value number The estimate as a plain number (m)
---@field why string Why it is not valid
---@operator add(number|error_estimate): number
---@operator sub(number|error_estimate): number
---@operator mul(number|error_estimate): number
---@operator div(number|error_estimate): number
---@operator unm: number
local error_estimate_methods = {}

---Energy by term, all rods
---@class energy
---@field bend number Bending (J)
---@field contact number Elastic energy of contact (J)
---@field gravity number Weight times height above the world origin (J)
---@field load number Potential of the dead loads (J)
---@field shear number Shear (J)
---@field stretch number Stretch (J)
---@field total number Sum of all (J)
---@field twist number Twist (J)
local energy_methods = {}

---A force that the surroundings exert on a rod
---@class contact
---@field at vec Place on the centre line (m)
---@field force vec On the rod, world axes (N)
---@field gap number Between the surfaces; negative: penetration (m)
---@field length number Of the rod that it stands for (m)
---@field on string Name of the obstacle
---@field rod string Name of the rod
---@field s number Arc length (m)
local contact_methods = {}

---What a hold or a branch point does to a rod
---@class support
---@field force vec On the rod, world axes (N)
---@field moment vec On the rod, about its centre line there, world axes (N m)
---@field s number Arc length; of a slide clip: where the rod has settled in it (m)
local support_methods = {}

---One branch point in equilibrium
---@class solved_branch
---@field force vec Of what holds it, world axes; zero where it is free (N)
---@field frame frame Where it is
---@field moment vec Of what holds it, about its place, world axes (N m)
---@field name string Its name in the scene
local solved_branch_methods = {}

---One rod in equilibrium
---@class solved_rod
---@field arc_lengths (number)[] Of the vertices, unstressed (m)
---@field bend_radius (number)[] At the vertices (m)
---@field clearance clearance Smallest gap to any obstacle (m)
---@field contact_length number Of the rod that the surroundings press on (m)
---@field contacts (contact)[] Forces of the surroundings on it
---@field design rod What it is
---@field frames (frame)[] Sections at the vertices
---@field length number Of the deformed centre line (m)
---@field max_strain number The largest
---@field max_tension number The largest; negative: compression everywhere (N)
---@field min_bend_radius number The smallest; math.huge when straight (m)
---@field name string Its name in the scene
---@field ok boolean Solved
---@field points (vec)[] Vertices of the centre line (m)
---@field status string How the solve ended
---@field supports (support)[] What its holds, in the order they were given, and branch points do to it
---@field tension (number)[] Of each segment; negative: compression (N)
---@field twist (number)[] Of each segment (rad/m)
local solved_rod_methods = {}

---The section's frame at an arc length in m.
---@param s number
---@return frame
function solved_rod_methods:at(s) end

---A scene in static equilibrium, as it was when it was solved
---@class equilibrium
---@field contacts (contact)[] Forces of the surroundings on the rods
---@field convergence (number)[] Sizes of the steps of Newton's method (rad, or shares of the length), one an iteration, of the system that took the most
---@field deepest_penetration number 0 without contact (m)
---@field eigenvalues (number)[]? Softest first: stiffness against the softest disturbances, a pure number (EI/L^2 times a turn's share of the length); negative: unstable; nil unless solved with modes = true
---@field energy energy By term (J)
---@field error error_estimate? Estimated discretisation error; nil unless solved with error = true (m)
---@field iterations integer Newton steps, all rods
---@field measures (string)[] Names of the measures that eq:gradient knows
---@field message string What there is to say about it
---@field modes (equilibrium)[]? Other stable equilibria for the same holds, by growing energy; nil unless solved with modes = true
---@field ok boolean Every rod is solved
---@field parameters (string)[] Names of all that eq:gradient can differentiate by
---@field residual number Largest unbalanced force, or moment over length (N)
---@field rods (string)[] Names of the rods
---@field seconds number Time to solve, without building trees (s)
---@field seconds_for_trees number Time to build the obstacles' trees, 0 when they stood already (s)
---@field softest_mode table<string, (vec)[]>? By rod: how far the vertices move (m) along the softest disturbance; nil unless solved with modes = true
---@field stable boolean No negative eigenvalue
---@field status string "solved", "stalled", "cancelled", "timeout"
local equilibrium_methods = {}

---One branch point in equilibrium.
---@param name string
---@return solved_branch
function equilibrium_methods:branch(name) end

---@class (exact) tendril.equilibrium.clearance.options
---@field from? string The rod; may be left out when there is only one
---@field to? string The obstacle; default: the nearest of all

---The smallest gap between a rod's surface and an obstacle; computes as a number in m.
---@param options? tendril.equilibrium.clearance.options
---@return clearance
function equilibrium_methods:clearance(options) end

---Force (N, world axes) of the support or branch point on the rod at a hold or joint.
---@param name string
---@param where string|number
---@return vec
function equilibrium_methods:force(name, where) end

---Exact first derivatives of a measure by parameters, in SI units. The measure: a name (eq.measures), a table {rod =, what =, at =, along =}, or a function of an equilibrium (then by differences). The parameters: names (eq.parameters), or what several begin with: "hose.to", "gravity".
---@param measure string|function|{rod: string, what: string, at: number|string?, along: vec?, to: string?}
---@param parameters (string)[]
---@return gradient
function equilibrium_methods:gradient(measure, parameters) end

---Moment (N m, world axes, about the centre line) of the support or branch point on the rod at a hold or joint.
---@param name string
---@param where string|number
---@return vec
function equilibrium_methods:moment(name, where) end

---@class (exact) tendril.equilibrium.quantities.options
---@field wires? table<string, (string)[]> By wire, the names of the rods that it runs through: {W1 = {"trunk", "left"}}
---@field clearance? number How much more a metre costs next to obstacles, as weights.clearance in routing (>= 0; default 0)
---@field preference? number How much more a metre costs next to obstacles with prefer = "avoid", and away from those with prefer = "near" (>= 0; default 0)
---@field range? number Gap from which on neither counts (m; > 0; default 0.1)
---@field free_ends? number At the rods' ends, not judged for collision (m; >= 0; default 0)

---What the harness is measured by: lengths, volume, mass, clips, branch points, length in collision, cost; and lengths by wire.
---@param options? tendril.equilibrium.quantities.options
---@return quantities
function equilibrium_methods:quantities(options) end

---One rod in equilibrium.
---@param name string
---@return solved_rod
function equilibrium_methods:rod(name) end

---@class (exact) tendril.equilibrium.save.options
---@field rods? boolean Rods as tubes (default true)
---@field obstacles? boolean Obstacles (default true)
---@field robots? boolean The robots' links (default true)
---@field tolerance? number Of the tubes' facets from the round, bent rods; default: 2 % of each rod's radius (m; > 0)
---@field unit? "mm"|"cm"|"m"|"in" Length unit of the file; default "m". A .glb is always in m

---Writes the rods as .csv (a line a vertex: rod, s, place, tangent, bend radius, tension), or all that was solved as .glb, .obj, .stl or .ply, as s:export does.
---@param path string
---@param options? tendril.equilibrium.save.options
---@return saved_file
function equilibrium_methods:save(path, options) end

---What one rod is measured by
---@class rod_quantities
---@field clips integer Holds between the ends
---@field cost number Length, and what its run costs more by clearance and preference (m)
---@field held_ends integer Ends that are held; those at branch points do not count
---@field length number Of the centre line at rest (m)
---@field length_in_collision number Where it penetrates an obstacle by more than contact leaves (m)
---@field mass number All of it (kg)
---@field name string Its name in the scene
---@field unstressed_length number Without load (m)
---@field volume number Of the space it takes; what is hollow counts as full (m^3)
local rod_quantities_methods = {}

---What a harness is measured by, in all and by rod
---@class quantities
---@field branches integer Number of branch points
---@field cable_length number Of all wires (m)
---@field clips integer Holds between the ends
---@field cost number Length, and what its run costs more by clearance and preference (m)
---@field held_ends integer Ends that are held; those at branch points do not count
---@field length number Of the centre line at rest (m)
---@field length_in_collision number Where it penetrates an obstacle by more than contact leaves (m)
---@field mass number All of it (kg)
---@field rods (rod_quantities)[] List by rod
---@field unstressed_length number Without load (m)
---@field volume number Of the space it takes; what is hollow counts as full (m^3)
---@field wire_lengths table<string, number> By wire, at rest (m)
local quantities_methods = {}

---A joint of a robot that moves by itself: one entry of its joint values
---@class joint
---@field kind string "revolute", "continuous" or "prismatic"
---@field link string The link that it carries
---@field lower number Lower limit; -math.huge without one (rad or m)
---@field name string Its name
---@field upper number Upper limit; math.huge without one (rad or m)
---@field velocity number The fastest it goes; math.huge when that is not stated (rad/s or m/s)
local joint_methods = {}

---Rigid links joined in a tree; it never changes. Joint values are lists of numbers (rad or m) in the order of `joints`; frames stand in the axes of its base, with d1, d2, d3 as a link's x, y, z axes
---@class robot
---@field joints (joint)[] The joints that move by themselves, in the order of joint values
---@field links (string)[] Names of the links, the base first
---@field name string Its name
---@field tip string Name of the link at the end of the arm
local robot_methods = {}

---@class (exact) tendril.robot.collides.options
---@field scene? scene Its obstacles count as well, against all links that move; default: the robot alone
---@field at? frame Where the robot's base stands in the scene; default: the origin, z up

---The pairs that touch, each {link, link} or {link, obstacle}; an empty list: none.
---@param q (number)[]
---@param options? tendril.robot.collides.options
---@return ((string)[])[]
function robot_methods:collides(q, options) end

---How a link's frame moves with the joints, in the link's own axes: three rows for its origin (m), three for its rotation vector (rad), a column for each joint.
---@param link string
---@param q (number)[]
---@return ((number)[])[]
function robot_methods:jacobian(link, q) end

---Where a link is.
---@param link string
---@param q (number)[]
---@return frame
function robot_methods:link_frame(link, q) end

---A link's bodies as one mesh, in the link's axes: for pictures, and as an obstacle.
---@param link string
---@return mesh
function robot_methods:mesh(link) end

---What bot:collides looks at: {link, link, kind} for all pairs of links with bodies. Kinds: "checked"; "rigid", "neighbours", "always" and "never" (touching, at 10,000 places within the limits) are not.
---@return ((string)[])[]
function robot_methods:pairs() end

---@class (exact) tendril.robot.program.options
---@field dialect "rapid"|"krl"|"urscript"|"ls"|"csv" RAPID (ABB), KRL (KUKA), URScript, LS (FANUC), or rows of numbers
---@field name? string Of the program (default "path")
---@field speed? number Share of the joints' velocities (> 0 and <= 1; default 0.5)
---@field zone? number How near to each point but the first and last the corner may be cut; 0: stop at each (m; >= 0; default 0)
---@field sign? (number)[] 1 or -1 for each joint: the controller shows sign * q + zero. Default of the map: that of the dialect's maker for upright arms of six axes
---@field zero? (number)[] What the controller shows for each joint where q is 0; default with a sign: 0 (rad)
---@field coupling? number How much of the second axis the third one shows on top; FANUC: -1 with sign -1; default with a sign: 0

---A joint path as the program of a robot controller, in text: moves from point to point by their joints.
---@param path ((number)[])[]
---@param options tendril.robot.program.options
---@return string
function robot_methods:program(path, options) end

---@class (exact) tendril.robot.reaches.options
---@field link? string The link to bring there; default: the robot's tip
---@field near? (number)[] Joint values: the nearest solutions come first, and joints that are free stay there; default: 0 (rad or m)
---@field limits? boolean Only within the joint limits (default true)
---@field turns? boolean Also solutions that differ by whole turns, where the limits leave room (default true)
---@field starts? integer Of the numeric search, for arms without a closed form (1 ... 1000000; default 100)

---All joint values that bring a link to a frame, or nil and the reason. With solutions the second result tells which joints are free there, or nil.
---@param frame frame
---@param options? tendril.robot.reaches.options
---@return (number)[][]|nil, string?
function robot_methods:reaches(frame, options) end

---@class (exact) tendril.robot.read_program.options
---@field dialect? "rapid"|"krl"|"urscript"|"ls"|"csv" Default: by the suffix (.mod, .prg; .src; .script; .ls; .csv, .txt)
---@field unit? "deg"|"rad" Of the turning joints in a csv file (default "deg")
---@field sign? (number)[] 1 or -1 for each joint: the controller shows sign * q + zero. Default of the map: that of the dialect's maker for upright arms of six axes
---@field zero? (number)[] What the controller shows for each joint where q is 0; default with a sign: 0 (rad)
---@field coupling? number How much of the second axis the third one shows on top; FANUC: -1 with sign -1; default with a sign: 0

---The points that a program or a table of joint values goes through: what bot:program writes, and programs of others that move by joints alone.
---@param file string
---@param options? tendril.robot.read_program.options
---@return ((number)[])[]
function robot_methods:read_program(file, options) end

---Whether joint values keep the limits; if not, also which do not.
---@param q (number)[]
---@return boolean, string?
function robot_methods:within_limits(q) end

---A robot in a scene
---@class placed_robot
---@field at frame Where its base stands
---@field design robot The robot itself
---@field joints (number)[] Where its joints stand (rad or m)
---@field name string Its name in the scene
---@field rods (string)[] Names of the rods that are attached to it
local placed_robot_methods = {}

---Where a link is, in world axes.
---@param link string
---@return frame
function placed_robot_methods:frame(link) end

---Moves its joints, and with the links what is attached to them. An error where values are beyond the limits.
---@param joints (number)[]
---@return placed_robot
function placed_robot_methods:move(joints) end

---Derivatives of a measure, by parameter: g["hose.length"]
---@class gradient
---@field derivatives table<string, number> By name, in SI units
---@field measure string Its name
---@field message string Why they do not
---@field ok boolean The derivatives exist
---@field parameters (string)[] Names, in the order asked for
---@field unit string Of the measure
---@field value number Of the measure, in its SI unit
---@field [string] any
local gradient_methods = {}

---Where a grip is over the common time: path(t) is its frame at t = 0 ... 1
---@class grip_path
---@field connection boolean It is held in the routed configuration; else it lets go at the end
---@field frames (frame)[] At those times
---@field name string "hose.start", or a branch point's name
---@field rod string? Name of the rod that is gripped; nil: a branch point
---@field s number? Arc length of the grip on its rod; nil: a branch point (m)
---@field times (number)[] Rising from 0 to 1
local grip_path_methods = {}

---Its frame at t = 0 ... 1; path(t) says the same.
---@param t number
---@return frame
function grip_path_methods:at(t) end

---The paths of all grips, by name or number: #paths, paths[i]
---@class grip_paths
---@field [string] any
---@field [integer] any
---@operator len: integer
local grip_paths_methods = {}

---One try to install a system: a handle pulled out, and what was traced played forward
---@class assembly_attempt
---@field gravity boolean It acted while the system was pulled out
---@field grips integer That moved it in; 0: it did not come out
---@field handle string Rod and share of its length, or branch point, that it was pulled by
---@field outcome string "proven", or what stopped it
---@field seconds number Run time (s)
---@field smoothed boolean The traces were
local assembly_attempt_methods = {}

---The worst of all states on the way in
---@class assembly_worst
---@field bend_radius number The smallest (m)
---@field clearance number The smallest; negative: so deep in contact (m)
---@field strain number Of the outermost fibre
---@field when table<string, number> {strain =, bend_radius =, clearance =}: t = 0 ... 1 of each
---@field where table<string, string> {strain =, bend_radius =, clearance =}: names of rods and of the nearest obstacle
local assembly_worst_methods = {}

---How the manipulation was played forward
---@class assembly_proof
---@field deviation number Of the last state from the routed configuration, at most (m)
---@field message string What went wrong, where
---@field ok boolean Proven
---@field steps integer Equilibria on the way
local assembly_proof_methods = {}

---A manipulation that installs a system of rods, or why none was found
---@class assembly
---@field attempts (assembly_attempt)[] List of what was tried, in order
---@field duration number Of the common time: t = 1 (s)
---@field handle_path (vec)[] Of the handle, outwards, as it was searched (m)
---@field hands integer Grips to be held at the same time, at most
---@field message string How it ends, or what stopped the best attempt, and where
---@field ok boolean Found, and proven by playing it forward
---@field paths grip_paths Where each grip is: paths["hose.start"](t), t = 0 ... 1 from outside to the routed configuration
---@field proof assembly_proof How the forward play went
---@field replays table<string, integer> {of =, arrived =}: replays by hands that stray by a quarter of the thickest radius; where some do not arrive it is fragile
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field stopped_at vec? Where the best attempt was stopped; nil: one was proven (m)
---@field worst assembly_worst Strain, bend radius and clearance on the way, when and where
local assembly_methods = {}

---@class (exact) tendril.assembly.chart.options
---@field title? string Above it; default: "Installation"

---Strain, bend radius, clearance and hands over time, one below the other.
---@param options? tendril.assembly.chart.options
---@return sheet
function assembly_methods:chart(options) end

---The equilibrium that was played nearest to t = 0 ... 1; at 1 the connections alone hold it. Where none was proven: of the attempt that came furthest.
---@param t number
---@return equilibrium
function assembly_methods:frame(t) end

---Grips to be held at t = 0 ... 1: one that is a connection and at rest until the end is plugged in and needs no hand.
---@param t number
---@return integer
function assembly_methods:hands_at(t) end

---@class (exact) tendril.assembly.save.options
---@field rods? boolean Rods as tubes (default true)
---@field obstacles? boolean Obstacles (default true)
---@field robots? boolean The robots' links (default true)
---@field tolerance? number Of the tubes' facets from the round, bent rods; default: 2 % of each rod's radius (m; > 0)

---Writes the paths of all grips into a .csv or .json (s, mm, quaternions), or what was played as an animated .glb.
---@param path string
---@param options? tendril.assembly.save.options
---@return saved_file
function assembly_methods:save(path, options) end

---One step of the search for a better path
---@class search_step
---@field accepted boolean The path was changed
---@field objective number After it
---@field radius number Of the trust region (rad)
---@field step number Its length, all via points together (rad)
local search_step_methods = {}

---A limit that a motion does not keep: where it is worst
---@class unmet_limit
---@field at_end boolean Worst in the first or last configuration, which no via point changes
---@field demanded number What was asked for (N, rad/m or m)
---@field from number Not kept from this time
---@field t number When
---@field text string In words
---@field to number to this
---@field value number What it is (N, rad/m or m)
---@field what string "tension", "twist", "bend_radius", "clearance" or "robot_clearance"
---@field where string The hold, rod or link
local unmet_limit_methods = {}

---A robot's path for its hoses, before and after
---@class dress_pack
---@field after pack_motion The motion on the optimised path
---@field before pack_motion The motion on the given path
---@field given ((number)[])[] The path as it was, through as many via points (rad or m)
---@field history (search_step)[] Of the search, step by step
---@field message string What there is to say about it
---@field objective number What the search made least
---@field objective_before number The same where its last round began
---@field ok boolean The path keeps all that is demanded
---@field path ((number)[])[] Joint values of its via points (rad or m)
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field unmet (unmet_limit)[] Limits that the optimised path does not keep
---@field unmet_before (unmet_limit)[] Limits that the given path does not keep
local dress_pack_methods = {}

---@class (exact) tendril.dress_pack.chart.options
---@field title? string Above it; default: "Dress pack"

---What the rods bear over time on the given path and on the optimised one.
---@param options? tendril.dress_pack.chart.options
---@return sheet
function dress_pack_methods:chart(options) end

---The equilibrium on the optimised path at the time step nearest to t = 0 ... 1.
---@param t number
---@return equilibrium
function dress_pack_methods:frame(t) end

---@class (exact) tendril.dress_pack.program.options
---@field name? string Of the program (default "path")
---@field speed? number Share of the joints' velocities (> 0 and <= 1; default 0.5)
---@field zone? number How near to each point but the first and last the corner may be cut; 0: stop at each (m; >= 0; default 0)
---@field sign? (number)[] 1 or -1 for each joint: the controller shows sign * q + zero. Default of the map: that of the dialect's maker for upright arms of six axes
---@field zero? (number)[] What the controller shows for each joint where q is 0; default with a sign: 0 (rad)
---@field coupling? number How much of the second axis the third one shows on top; FANUC: -1 with sign -1; default with a sign: 0

---The optimised path as the program of a robot controller, in text: "rapid", "krl", "urscript", "ls" or "csv".
---@param dialect string
---@param options? tendril.dress_pack.program.options
---@return string
function dress_pack_methods:program(dialect, options) end

---Numbers of a dress pack, adjusted for motions that stay as they are
---@class pack_design
---@field after (pack_motion)[] The motions of the adjusted one
---@field before (pack_motion)[] The motions of the given pack, without contact
---@field history (number)[] The objective, step by step
---@field message string What there is to say about it
---@field objective number What the search made least
---@field objective_before number The same of the given pack
---@field ok boolean The search came to its end
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field values table<string, number> By name, the best that were found (m or rad)
local pack_design_methods = {}

---A rod of a dress pack that left its equilibrium and came to rest in another one
---@class pack_snap
---@field energy_drop number Energy set free (J)
---@field move number The farthest that a place on it moved (m)
---@field t number Just after this share of the path
local pack_snap_methods = {}

---A dress pack that follows its robot along a path, from equilibrium to equilibrium
---@class pack_motion
---@field clearance number The smallest of the rods from obstacles and links; infinite: nothing is near (m)
---@field length number Of the path, the joints together (rad or m)
---@field max_tension number The largest force between a hold and its rod (N)
---@field max_twist number The largest change against the unstressed rods (rad/m)
---@field message string What there is to say about it
---@field min_bend_radius number The smallest (m)
---@field ok boolean It came to the end of the path
---@field residual number The largest that was left unbalanced (N)
---@field seconds number Run time (s)
---@field snaps (pack_snap)[] Snap-throughs, in time order
---@field tensions (number)[] The largest force of a hold at those times (N)
---@field times (number)[] Shares of the path
local pack_motion_methods = {}

---The equilibrium, with the robot where it is, at the time step nearest to t = 0 ... 1.
---@param t number
---@return equilibrium
function pack_motion_methods:frame(t) end

---The robot's joint values at t = 0 ... 1.
---@param t number
---@return (number)[]
function pack_motion_methods:joints(t) end

---@class (exact) tendril.pack_motion.motion.options
---@field states? integer Evenly spaced, first and last among them (1 ... 100000; default 40)

---Its states as a motion: for envelopes, gaps and pictures.
---@param options? tendril.pack_motion.motion.options
---@return motion
function pack_motion_methods:motion(options) end

---How an envelope was made
---@class envelope_report
---@field failed integer Outcomes without an equilibrium: not contained
---@field jumped integer Contained, in another equilibrium than the nominal one's continuation
---@field left_out integer How many were left out for the share
---@field margin number Added to the radii so that the grid loses nothing (m)
---@field ok boolean There is a mesh
---@field outcomes integer Contained
---@field resolution number Grid step (m)
---@field sagitta number Added for the centre line's bulge from its chords (m)
---@field seconds number For the envelope (s)
---@field seconds_for_outcomes number For solving them (s)
---@field status string How it ended
---@field steps table<string, number> Seconds of each step, by name (s)
---@field volume number Within the envelope (m^3)
local envelope_report_methods = {}

---Frames of a body over time, read by study.motion
---@class sampled_motion
---@field frames (frame)[] Of the body, at those times
---@field times (number)[] Rising (s)
local sampled_motion_methods = {}

---The body's frame at a time (s), evenly between the samples.
---@param time number
---@return frame
function sampled_motion_methods:at(time) end

---The frames of a place that moves with the body and is given as it is at the first sample.
---@param place frame
---@return (frame)[]
function sampled_motion_methods:carried(place) end

---Rods that left their equilibrium and came to rest in another one
---@class snap_through
---@field energy_drop number Energy set free (J)
---@field move number By so much (m)
---@field rod string Which moved farthest
---@field s number At this arc length (m)
---@field t number When
local snap_through_methods = {}

---A quasi-static motion
---@class motion
---@field equilibria (equilibrium)[] At those times
---@field message string What there is to say about it
---@field ok boolean It went to the end
---@field seconds number Run time (s)
---@field snaps (snap_through)[] Snap-throughs, in time order
---@field solves integer Equilibria that were computed
---@field status string "solved", "stalled", "cancelled", "timeout"
---@field times (number)[] t of the equilibria
local motion_methods = {}

---@class (exact) tendril.motion.clearance.options
---@field from? string The rod; may be left out when there is only one
---@field to? string The obstacle; default: the nearest of all

---The smallest gap at each of those times: a list.
---@param options? tendril.motion.clearance.options
---@return (clearance)[]
function motion_methods:clearance(options) end

---@class (exact) tendril.motion.envelope.options
---@field resolution? number Grid step; at most the thinnest rod's radius (m; > 0; default 0.002)
---@field share? number Of the outcomes that it contains entirely; 1: all of them (> 0 and <= 1; default 1)
---@field memory? number That it may take: more is refused (bytes; > 0; default 2000000000)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---A watertight mesh that contains the rods at the times that the motion kept and on straight ways between them, and how it was made.
---@param options? tendril.motion.envelope.options
---@return mesh, envelope_report
function motion_methods:envelope(options) end

---@class (exact) tendril.motion.save.options
---@field seconds? number How long it plays (s; > 0 and <= 1000000; default 5)
---@field rods? boolean Rods as tubes (default true)
---@field obstacles? boolean Obstacles (default true)
---@field robots? boolean The robots' links (default true)
---@field tolerance? number Of the tubes' facets from the round, bent rods; default: 2 % of each rod's radius (m; > 0)

---Writes it as an animated .glb: rods bend, robots' links and other bodies move, between its solutions evenly.
---@param path string
---@param options? tendril.motion.save.options
---@return saved_file
function motion_methods:save(path, options) end

---A junction or a free end on a build board
---@class board_point
---@field at vec Board axes: z = 0 (m)
---@field name string Of the branch point, or "rod.finish"
local board_point_methods = {}

---A rod on a build board
---@class board_line
---@field design_length number Unstressed (m)
---@field length number On the board (m)
---@field points (vec)[] Board axes (m)
---@field rod string Its name
local board_line_methods = {}

---A layout on a plane build board; draw it with view.new{board}
---@class board
---@field crossings integer That are left
---@field equilibrium equilibrium On the board; nil: none
---@field height number Of the board (m)
---@field lines (board_line)[] Rods
---@field message string How it lies; what crosses or is strained
---@field ok boolean It lies flat, without crossings, as far apart as asked for
---@field points (board_point)[] Junctions and free ends
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field strain number Of lying flat, at most
---@field width number Of the board (m)
local board_methods = {}

---Writes the layout into a .csv, in mm: junctions and ends, then the points of each rod.
---@param path string
---@return saved_file
function board_methods:save(path) end

---One branch of a routed harness
---@class harness_branch
---@field clearance clearance Smallest gap of its route, certified (m)
---@field curve curve Its route
---@field from string Connection or junction
---@field length number Of its route (m)
---@field min_bend_radius number Of its route (m)
---@field name string Of its rod
---@field rod_length number Of its rod, unstressed (m)
---@field settled_bend_radius number In equilibrium (m)
---@field settled_clearance number In equilibrium (m)
---@field to string Connection or junction
---@field wires (integer)[] Numbers of the wires in it
local harness_branch_methods = {}

---A clip that holds a branch of a harness on its route
---@class harness_clip
---@field at number Arc length along the unstressed rod (m)
---@field branch integer Number of the branch
---@field force number That it bears at rest (N)
---@field frame frame Of the section that it holds
---@field obstacle string To which it is fastened
---@field route_at number Arc length along the route (m)
local harness_clip_methods = {}

---A branch point of a routed harness
---@class harness_junction
---@field branches (integer)[] Numbers of the branches, the trunk's two first
---@field frame frame As routed; along the trunk
---@field settled frame In equilibrium
local harness_junction_methods = {}

---A branched harness: as routed, and in equilibrium
---@class harness
---@field branches (harness_branch)[] List of branches
---@field cable_length number Over all wires (m)
---@field clips (harness_clip)[] List of clips, by branch
---@field cost number Of the route: what a metre costs, by weights, preferences and wires, along all branches (m)
---@field equilibrium equilibrium Rods named as the branches; nil: none
---@field harness_length number Of all branches (m)
---@field junctions (harness_junction)[] List of branch points
---@field length_in_collision number Settled, where it penetrates an obstacle (m)
---@field message string What there is to say about it
---@field misses (string)[] What is not kept, in words
---@field ok boolean The route keeps all that is demanded, and came to rest; see settled_misses for what gravity takes away
---@field preference number Integral along the route of what clearance weight and preferences make a metre cost more (m)
---@field restarts integer That refinement took
---@field seconds number Run time (s)
---@field settled_misses (string)[] What the route keeps, but the harness at rest does not, in words
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field wire_lengths (number)[] By wire, from connection to connection along the route (m)
local harness_methods = {}

---A new scene: the obstacles, and the harness as rods joined at its branch points and held by its clips.
---@return scene
function harness_methods:scene() end

---One bend of a hose, as the bending machine makes it
---@class bend
---@field angle number How far it turns (rad)
---@field plane number Turn of its plane against the last bend's, right-handed about the way forward; 0 for the first (rad)
---@field radius number Of the centre line (m)
---@field s number Arc length where it begins (m)
---@field straight_before number Between the last bend, or the start, and this one (m)
---@field vertex vec Where the straights before and after it would meet (m)
local bend_methods = {}

---How far gravity moves a hose; computes as a number (m)
---@class settled_hose
---@field equilibrium equilibrium Of the rod "hose"
---@field ok boolean The equilibrium was found
---@field s number Arc length where (m)
---@field value number Largest distance from the shape as formed (m)
---@operator add(number|settled_hose): number
---@operator sub(number|settled_hose): number
---@operator mul(number|settled_hose): number
---@operator div(number|settled_hose): number
---@operator unm: number
local settled_hose_methods = {}

---A preformed hose: straights joined by bends
---@class hose
---@field bends (bend)[] List of bends
---@field clearance clearance Smallest gap, with .at, .on, .s; certified along its true arcs and straights (m)
---@field curve curve The centre line
---@field from frame Frame of its start, for scene:rod
---@field label string What sets it apart
---@field length number Of the centre line (m)
---@field mesh mesh Its surface, to save, or to place as an obstacle for the next hose
---@field objective number Length, or what it costs with preferences (m)
---@field passage integer Hoses with one number can be moved into each other
---@field rod rod As a design for scene:rod; needs a section
---@field to frame Frame of its finish
local hose_methods = {}

---@class (exact) tendril.hose.save.options
---@field table? "LRA"|"XYZ"|"centre_line" What a .csv holds (default "LRA")
---@field unit? "mm"|"cm"|"m"|"in" Of a mesh; default "m"

---Writes a table as .csv (mm, degrees), or its surface as .stl, .ply, .obj or .glb.
---@param path string
---@param options? tendril.hose.save.options
---@return saved_file
function hose_methods:save(path, options) end

---@class (exact) tendril.hose.settle.options
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)
---@field segments? integer Elements; default by its bends (>= 1)

---Gravity check: how far its equilibrium is from the shape as formed, with .equilibrium, .s. Needs a section.
---@param options? tendril.hose.settle.options
---@return settled_hose
function hose_methods:settle(options) end

---Its bending table as text, mm and degrees: "LRA" (length, rotation, angle) or "XYZ".
---@param kind? string
---@return string
function hose_methods:table(kind) end

---Distinct hoses, the best first: #hoses, hoses[i]
---@class preform_result
---@field message string How many, or what stood in the way
---@field near_misses (string)[] What the best candidates lack where nothing is feasible
---@field ok boolean There is at least one hose, and the search was not stopped
---@field passages integer Number of passages that the hoses take
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field [integer] any
---@operator len: integer
local preform_result_methods = {}

---The card, the steps and every hose with its bending table, as text.
---@return string
function preform_result_methods:report() end

---One parameter before and after refinement
---@class adjusted_parameter
---@field after number Value found
---@field before number Value given
---@field name string "length", "from.turn" ...
---@field unit string m or rad
local adjusted_parameter_methods = {}

---A demand that is not kept in equilibrium
---@class unmet_demand
---@field at vec Place on the centre line (m)
---@field demanded number What was demanded
---@field s number Arc length where (m)
---@field text string In words
---@field value number What it is
local unmet_demand_methods = {}

---A refined design and its equilibrium
---@class refined_design
---@field adjusted (adjusted_parameter)[] Each parameter before and after
---@field clearance clearance? Smallest gap outside the free ends, with .at, .on, .s (m)
---@field equilibrium equilibrium Of this rod alone, called "route"; nil: there was none
---@field evaluations integer Equilibria that were looked at
---@field from frame Frame of its start
---@field message string What there is to say about it
---@field min_bend_radius number In equilibrium (m)
---@field min_bend_radius_at number Arc length where (m)
---@field objective number What it costs (m)
---@field ok boolean All that is demanded is kept, in a stable equilibrium
---@field rod rod The refined design
---@field seconds number Run time (s)
---@field settled_length number Of the centre line in equilibrium (m)
---@field status string "solved", "infeasible", "stalled", "cancelled", "timeout"
---@field to frame Frame of its finish
---@field unmet (unmet_demand)[] Demands that are not kept, the worst first
local refined_design_methods = {}

---One design of a flexible object: nominal, and refined in equilibrium
---@class route
---@field clearance clearance Smallest gap outside the free ends, with .at, .on, .s; in equilibrium, else of the nominal route (m)
---@field clip_places (number)[] Arc lengths of the clips (m)
---@field clips (frame)[] Frames of the clips that hold it, from start to finish
---@field equilibrium equilibrium Settled; nil: none was asked for, or found
---@field from frame Frame of its start
---@field length number Of the rod, unstressed (m)
---@field mesh mesh Its surface in equilibrium, else of the nominal route: to save, or to place as an obstacle for the next object
---@field min_bend_radius number In equilibrium, else of the nominal route (m)
---@field nominal curve The nominal route
---@field nominal_length number Of the nominal route (m)
---@field objective number What it costs (m)
---@field ok boolean Keeps all that is demanded
---@field preference number What clearance and preferences add to the length in its objective (m)
---@field refined refined_design Its refinement
---@field restarts integer That it took
---@field rod rod As a design for scene:rod
---@field to frame Frame of its finish
---@field weights table<string, number> It was routed with
local route_methods = {}

---Routes, those that keep all first: #routes, routes[i]
---@class routes
---@field front (route)[] Those that no other one beats in both length and clearance, by rising length
---@field message string How many, or what stood in the way
---@field ok boolean At least one route keeps all that is demanded
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each
---@field [integer] any
---@operator len: integer
local routes_methods = {}

---@class (exact) tendril.routes.chart.options
---@field title? string Above it; default: "Routes: length against clearance"

---Clearance over length of all alternatives, with the line of those that no other one beats in both.
---@param options? tendril.routes.chart.options
---@return chart
function routes_methods:chart(options) end

---One of several objects that were routed in order
---@class routed_object
---@field name string As given
---@field ok boolean Keeps all that is demanded
---@field route route? The one that the objects after it keep clear of; nil: none was found
---@field routes routes Its alternatives, as method.route gives them
local routed_object_methods = {}

---Several objects, routed in order: #objects, objects[i]
---@class routed_objects
---@field message string How many, or which one found no way, and why
---@field ok boolean Each of them keeps all that is demanded
---@field seconds number Run time (s)
---@field status string "solved", "infeasible", "cancelled", "timeout"
---@field steps (step)[] Name, seconds, counts of each object
---@field [integer] any
---@operator len: integer
local routed_objects_methods = {}

---A new scene: the obstacles, and every object as a rod, held at its ends and clips.
---@return scene
function routed_objects_methods:scene() end

---One step of a method, by the thesis's name
---@class step
---@field counts table<string, number> How many of what
---@field name string Of the step
---@field seconds number Run time (s)
local step_methods = {}

---How measures answer to design variables: st.matrix[measure][variable], in SI units
---@class stability
---@field equilibrium equilibrium That it is about
---@field matrix table<string, table<string, number>> Derivatives by measure and variable
---@field measures (string)[] Names
---@field message string What there is to say about it
---@field ok boolean All derivatives exist
---@field seconds number Run time (s)
---@field status string How it ended
---@field variables (string)[] Names
---@field within table<string, table<string, number>> The same times the tolerances, in the measure's unit
local stability_methods = {}

---How far each vertex of a rod moves, m: the most that one variable does within its tolerance; without tolerances per unit of all variables.
---@param rod string
---@return (number)[]
function stability_methods:moves(rod) end

---An estimate that computes as a number, with its 95 % interval
---@class estimate
---@field high number Upper end
---@field kind string How the interval was made
---@field low number Lower end of the interval
---@field unit string SI
---@field value number The estimate
---@operator add(number|estimate): number
---@operator sub(number|estimate): number
---@operator mul(number|estimate): number
---@operator div(number|estimate): number
---@operator unm: number
local estimate_methods = {}

---What a variable contributes to a measure's variance, as shares of it
---@class contributor
---@field first estimate By itself (effects = n)
---@field linear number By the exact gradient at the nominal design
---@field name string Of the variable, or of variables that depend on each other
---@field regression number By linear regression over the outcomes
---@field total estimate With all its interactions (effects = n)
local contributor_methods = {}

---One outcome
---@class outcome
---@field measures table<string, number> By name; NaN where it failed
---@field message string Why it is not solved
---@field status string "solved", "jumped", "failed" or "unsolved"
---@field variables table<string, number> By name
local outcome_methods = {}

---The outcomes of a study, in order
---@class outcomes
---@field [integer] any
---@operator len: integer
local outcomes_methods = {}

---One measure over all outcomes
---@class measured
---@field contributors (contributor)[] Which variables are to blame for the variance, largest first; effects = n adds total effects
---@field count integer Outcomes that have it
---@field deviation estimate Standard deviation
---@field interval table<string, (number)[]> 95 % intervals {low, high} by name: mean, deviation and the quantiles
---@field max number Largest value
---@field mean estimate With its 95 % interval
---@field min number Smallest value
---@field missing integer Outcomes that failed
---@field name string Of the measure
---@field nominal number Of the nominal design
---@field q001 estimate Quantile: this share of the outcomes lies below
---@field q01 estimate Quantile: this share of the outcomes lies below
---@field q05 estimate Quantile: this share of the outcomes lies below
---@field q50 estimate Quantile: this share of the outcomes lies below
---@field q95 estimate Quantile: this share of the outcomes lies below
---@field q99 estimate Quantile: this share of the outcomes lies below
---@field q999 estimate Quantile: this share of the outcomes lies below
---@field unit string SI
---@field values (number)[] Of all outcomes that have it, in order
local measured_methods = {}

---The share of all outcomes above a limit.
---@param limit number
---@return estimate
function measured_methods:above(limit) end

---The share of all outcomes below a limit; its interval counts failed ones either way.
---@param limit number
---@return estimate
function measured_methods:below(limit) end

---The contributors as a table of text.
---@return string
function measured_methods:blame() end

---@class (exact) tendril.measured.histogram.options
---@field title? string Above it
---@field limit? number A line at this value

---A chart of how often which values occur.
---@param options? tendril.measured.histogram.options
---@return chart
function measured_methods:histogram(options) end

---The value below which this share (0 ... 1) of the outcomes lies.
---@param share number
---@return estimate
function measured_methods:quantile(share) end

---A chart of the measure over a variable or another measure, a point an outcome.
---@param variable string
---@return chart
function measured_methods:scatter(variable) end

---Many outcomes of a design: v["hose.min_bend_radius"].mean, or v.gap of a measure called gap
---@class variation
---@field failed (integer)[] Numbers of the outcomes without an equilibrium
---@field jumped (integer)[] Numbers of the outcomes in another equilibrium than the nominal one's continuation
---@field measures (string)[] Names
---@field message string How many, how many failed or jumped, and which
---@field nominal equilibrium The nominal equilibrium
---@field ok boolean Every outcome has its measures
---@field outcomes outcomes #v.outcomes, v.outcomes[k].variables, .measures, .status, .message
---@field seconds number Run time (s)
---@field status string "solved", "cancelled", "timeout"
---@field variables (string)[] Names of their components
---@field [string] any
local variation_methods = {}

---All values of a variable's component or a measure, in order; NaN where there is none.
---@param name string
---@return (number)[]
function variation_methods:column(name) end

---@class (exact) tendril.variation.envelope.options
---@field resolution? number Grid step; at most the thinnest rod's radius (m; > 0; default 0.002)
---@field share? number Of the outcomes that it contains entirely; 1: all of them (> 0 and <= 1; default 1)
---@field memory? number That it may take: more is refused (bytes; > 0; default 2000000000)
---@field uniform? boolean Every variable uniform over its tolerance, for the space that may be needed within the tolerances; false: spread as in the study (default true)
---@field outcomes? integer How many; default: as many as the study's (1 ... 10000000)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---A watertight mesh that contains the rods in every outcome (or a share of the outcomes), and how it was made.
---@param options? tendril.variation.envelope.options
---@return mesh, envelope_report
function variation_methods:envelope(options) end

---One outcome (counted from 1) again, as an equilibrium of the scene.
---@param outcome integer
---@return equilibrium
function variation_methods:equilibrium(outcome) end

---The measure of this name, also where a property hides it.
---@param name string
---@return measured
function variation_methods:measure(name) end

---The card with the contributors of every measure, as text.
---@return string
function variation_methods:report() end

---Writes the outcomes into a .csv: status, variables, measures, message.
---@param path string
---@return saved_file
function variation_methods:save(path) end

---A picture that was shown in the terminal, or why not
---@class shown_picture
---@field message string "shown", or why not and what to do instead
---@field ok boolean It was shown
---@field seconds number Time it took (s)
---@field status string "shown", "infeasible" (the terminal shows none), "cancelled" or "timeout"
local shown_picture_methods = {}

---A file that was saved
---@class saved_file
---@field ok boolean It was written
---@field path string Where
---@field seconds number Time it took (s)
---@field status string "saved", "cancelled" or "timeout"
local saved_file_methods = {}

---Shows a saved .png in a terminal that can (kitty, Ghostty, Konsole, iTerm2, WezTerm, sixels).
---@return shown_picture
function saved_file_methods:show() end

---A picture to be
---@class view
local view_methods = {}

---@class (exact) tendril.view.save.options
---@field size? (integer)[] {width, height}; default {1600, 1200} (pixels)
---@field sheet? (string)[] Views in rows of two: "iso", "front", "top", "side", "card"; default iso, front, top and card
---@field fit? string|(string)[] Rod, obstacle, robot or "envelope", or a list, that fills each view; default: rods, envelope and the robots that carry rods
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)
---@field frames? integer States of an assembly or a motion that are shown, the last one among them (1 ... 100; default 6)

---Draws it into a .png; a missing folder is created.
---@param path string
---@param options? tendril.view.save.options
---@return saved_file
function view_methods:save(path, options) end

---@class (exact) tendril.view.save_frames.options
---@field size? (integer)[] {width, height}; default {1600, 1200} (pixels)
---@field sheet? (string)[] Views in rows of two: "iso", "front", "top", "side", "card"; default iso, front, top and card
---@field fit? string|(string)[] Rod, obstacle, robot or "envelope", or a list, that fills each view; default: rods, envelope and the robots that carry rods
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)
---@field frames? integer How many, evenly spaced; default: all that the motion kept (1 ... 9999)

---A motion's states as frame_0001.png, frame_0002.png ... in a folder, for an animation: all through the same camera.
---@param folder string
---@param options? tendril.view.save_frames.options
---@return (saved_file)[]
function view_methods:save_frames(folder, options) end

---@class (exact) tendril.view.show.options
---@field size? (integer)[] {width, height}; default: as large as fits above the prompt (pixels)
---@field sheet? (string)[] Views in rows of two: "iso", "front", "top", "side", "card"; default iso
---@field fit? string|(string)[] Rod, obstacle, robot or "envelope", or a list, that fills each view
---@field frames? integer States of an assembly or a motion that are shown (1 ... 100; default 6)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Draws it between the lines of a terminal that can (kitty, Ghostty, Konsole, iTerm2, WezTerm, sixels).
---@param options? tendril.view.show.options
---@return shown_picture
function view_methods:show(options) end

---A chart to be
---@class chart
local chart_methods = {}

---@class (exact) tendril.chart.save.options
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Draws it into a .png or .svg; a missing folder is created.
---@param path string
---@param options? tendril.chart.save.options
---@return saved_file
function chart_methods:save(path, options) end

---Charts side by side
---@class sheet
local sheet_methods = {}

---@class (exact) tendril.sheet.save.options
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Draws them into one .png or .svg; a missing folder is created.
---@param path string
---@param options? tendril.sheet.save.options
---@return saved_file
function sheet_methods:save(path, options) end

---One number of segments in an accuracy study
---@class accuracy_row
---@field error number Against the reference (m)
---@field estimate number The solver's own estimate; NaN unless asked for and valid (m)
---@field fastest number The shortest of them (s)
---@field iterations integer Newton steps
---@field order number Observed against the row before; NaN in the first
---@field seconds number Median of repeated cold solves (s)
---@field segments integer Of every rod
---@field status string How the solve ended
local accuracy_row_methods = {}

---Error against run time
---@class accuracy
---@field element string Which element
---@field message string Why it is not complete
---@field ok boolean The study is complete
---@field reference_segments integer Of the reference solution; 0: exact
---@field reference_uncertainty number What is not known of the reference (m)
---@field rows (accuracy_row)[] One for each number of segments
---@field status string How it ended
local accuracy_methods = {}

---@class (exact) tendril.accuracy.chart.options
---@field with? (accuracy)[] Other accuracy studies to draw beside this one
---@field title? string Above it

---Error against run time, both logarithmic.
---@param options? tendril.accuracy.chart.options
---@return chart
function accuracy_methods:chart(options) end

---A vector from its components.
---@param x number
---@param y number
---@param z number
---@return vec
function vec(x, y, z) end

---@class (exact) tendril.frame.options
---@field at vec|number[] Place (m)
---@field along vec|number[] Direction of d3, the rod's tangent there; any length
---@field up? vec|number[] Direction that d1 leans to, made normal to `along`; without it z, or x for a vertical `along`

---A place and orientation of a section.
---@param options tendril.frame.options
---@return frame
function frame(options) end

---Says what a function, object, module or name is; for other words, what is called or does something like it.
---@param subject? any
function help(subject) end

---Calls a function: the seconds it took, then what it returned.
---@param run function
---@return number, any
function time(run) end

---Factors to SI: 60*units.mm is 0.06 (m)
units = {}

---metre (m)
---@type number
units.m = 0

---centimetre (m)
---@type number
units.cm = 0

---millimetre (m)
---@type number
units.mm = 0

---radian (rad)
---@type number
units.rad = 0

---degree (rad)
---@type number
units.deg = 0

---newton (N)
---@type number
units.N = 0

---kilonewton (N)
---@type number
units.kN = 0

---pascal (Pa)
---@type number
units.Pa = 0

---kilopascal (Pa)
---@type number
units.kPa = 0

---megapascal (Pa)
---@type number
units.MPa = 0

---gigapascal (Pa)
---@type number
units.GPa = 0

---kilogram (kg)
---@type number
units.kg = 0

---gram (kg)
---@type number
units.g = 0

---What a cable or hose is
rod = {}

---@class (exact) tendril.rod.wire.options
---@field outer number Outside diameter, with insulation (m; > 0)
---@field area number Metal in the conductor; 0: none, a filler or tube (m^2; >= 0)
---@field mass? number Measured; default: that of copper and PVC (kg/m; > 0)
---@field min_bend_radius? number Of its centre line; default: three outside diameters (m; >= 0)
---@field conductor? number Diameter of the circle around the conductor's strands; default: metal fills 0.7 of it (m; > 0)
---@field strands? integer In the conductor; default: as ISO 6722 makes up flexible wires of this area (1 ... 1000000)
---@field young? number Of the conductor's metal; default: copper (Pa; > 0)
---@field insulation_young? number Default: soft PVC (Pa; > 0)

---An insulated stranded wire, by default of copper and PVC.
---@param options tendril.rod.wire.options
---@return wire
function rod.wire(options) end

---@class (exact) tendril.rod.bundle.options
---@field wires (wire|{wire: wire, count: integer})[] List of wires, or of {wire =, count =}
---@field slip? number How freely wires and strands slip: 1 freely, 0 glued; default 0.85, with tape 0.7 (0 ... 1)
---@field taped? boolean Wound with tape, half overlapped (default false)
---@field tape_thickness? number All layers, on the radius (m; > 0; default 0.00026)
---@field tape_young? number Of the tape (Pa; > 0; default 30000000)
---@field tape_density? number Of the tape (kg/m^3; >= 0; default 1300)
---@field packing? number Wires' area over that of the circle around them; default: the known packings up to seven equal wires, otherwise 0.694 (> 0 and <= 1)

---The section of a bundle of wires, its stiffness between that of wires that slip freely and wires that are glued; and how it came about.
---@param options tendril.rod.bundle.options
---@return section, bundle
function rod.bundle(options) end

---@class (exact) tendril.rod.material.options
---@field young number Young's modulus (Pa; > 0)
---@field poisson? number Poisson's ratio; give this or shear (> -1 and <= 0.5)
---@field shear? number Shear modulus; give this or poisson (Pa; > 0)
---@field density number Mass per volume (kg/m^3; >= 0)

---An isotropic linear-elastic material.
---@param options tendril.rod.material.options
---@return material
function rod.material(options) end

---@class (exact) tendril.rod.section.options
---@field outer number Outer diameter (m; > 0)
---@field inner? number Inner diameter; 0: solid (m; >= 0; default 0)
---@field material? material What it is made of; the stiffnesses and the mass follow from it
---@field EA? number Measured stretch stiffness (N; > 0)
---@field GA? number|(number)[] Measured shear stiffness, or {along d1, along d2} (N)
---@field EI? number|(number)[] Measured bending stiffness, or {about d1, about d2} (N m^2)
---@field GJ? number Measured twist stiffness (N m^2; > 0)
---@field mass? number Measured mass per length (kg/m; >= 0)

---A cross-section, from a material or from measured stiffnesses.
---@param options tendril.rod.section.options
---@return section
function rod.section(options) end

---@class (exact) tendril.rod.new.options
---@field section section|({upto: number, [1]: section})[] Cross-section, or a list of {upto = s, section} along the rod
---@field length? number Unstressed length; that of the curve when there is a shape (m; > 0)
---@field shape? curve Unstressed shape of a preformed rod; default straight
---@field segments? integer Elements along the rod (1 ... 1000000; default 40)

---A rod design: straight, or preformed by a shape.
---@param options tendril.rod.new.options
---@return rod
function rod.new(options) end

---Shapes in space
curve = {}

---@class (exact) tendril.curve.polyline.options
---@field [integer] vec|number[] Two or more points, m

---Straight from point to point.
---@param options? tendril.curve.polyline.options
---@return curve
function curve.polyline(options) end

---@class (exact) tendril.curve.pcc.options
---@field points (vec|number[])[] Ends and corners (m)
---@field radius number|(number)[] Bend radius, or one for each inner point (m)

---Straights with each corner rounded by an arc: piecewise constant curvature.
---@param options tendril.curve.pcc.options
---@return curve
function curve.pcc(options) end

---@class (exact) tendril.curve.helix.options
---@field radius number From the axis to the centre line (m; > 0)
---@field pitch number Rise of one turn (m)
---@field turns number How many (> 0)
---@field left_handed? boolean Turns clockwise as it rises (default false)

---The circular helix about the z axis from {radius, 0, 0} on; d1 points to the axis.
---@param options tendril.curve.helix.options
---@return curve
function curve.helix(options) end

---@class (exact) tendril.curve.spline.options
---@field [integer] vec|number[] Two or more points to pass through, m
---@field start? vec|number[] Direction at the first point; default: no curvature there
---@field finish? vec|number[] Direction at the last point; default: no curvature there

---The cubic spline through points, with continuous curvature.
---@param options? tendril.curve.spline.options
---@return curve
function curve.spline(options) end

---The world that rods live in
scene = {}

---@class (exact) tendril.scene.new.options
---@field gravity? vec|number[] Acceleration in world axes; default or zero: the term is left out (m/s^2)

---An empty world.
---@param options? tendril.scene.new.options
---@return scene
function scene.new(options) end

---@class (exact) tendril.scene.mesh.options
---@field unit? "mm"|"cm"|"m"|"in" Length unit of the file or data; a file must be given one, data are in m otherwise

---A mesh from a file, or from {points =, triangles =}.
---@param source string|{points: vec[], triangles: integer[][]}
---@param options? tendril.scene.mesh.options
---@return mesh
function scene.mesh(source, options) end

---@class (exact) tendril.scene.import.options
---@field gravity? vec|number[] Acceleration in the file's axes; default or zero: the term is left out (m/s^2)
---@field shape? "drawn"|"straight" Without load: as the file draws it, or straight, as bundles come off the build board (default "drawn")
---@field clips? "fixed"|"slide"|"swivel"|"none" What fixings hold: everything, everything but sliding, the place only, or nothing (default "fixed")
---@field slip? number How freely wires slip in their bundles, 1 freely, 0 not at all; default as in rod.bundle (0 ... 1)
---@field element? number Longest element of a rod; bends make them shorter (m; 0.0001 ... 10; default 0.025)

---A harness file (.kbl, .vec) as a scene: a rod for every segment with the section of its bundle of wires, branch points, connectors and fixings as holds; and a report of what the file holds and how well it fits together.
---@param path string
---@param options? tendril.scene.import.options
---@return scene, imported_harness
function scene.import(path, options) end

---@class (exact) tendril.scene.box.options
---@field size vec|number[] Edge lengths along its x, y, z; its middle is the pose's place (m)

---A box.
---@param options tendril.scene.box.options
---@return solid
function scene.box(options) end

---@class (exact) tendril.scene.sphere.options
---@field radius number Radius; its middle is the pose's place (m; > 0)

---A sphere.
---@param options tendril.scene.sphere.options
---@return solid
function scene.sphere(options) end

---@class (exact) tendril.scene.cylinder.options
---@field radius number Radius (m; > 0)
---@field length number Length along its z; its middle is the pose's place (m; > 0)

---A cylinder with flat ends.
---@param options tendril.scene.cylinder.options
---@return solid
function scene.cylinder(options) end

---@class (exact) tendril.scene.plane.options

---Everything below a plane: solid where its own z is less than 0. `pose = frame{at =, along = normal}` places it.
---@param options? tendril.scene.plane.options
---@return solid
function scene.plane(options) end

---A scene that scene:save wrote: it solves to the same numbers. The second result lists what has changed since, as files of meshes; it is also told as a warning.
---@param path string
---@return scene, string[]
function scene.load(path) end

---Robots: what carries a dress pack
robot = {}

---A robot from a URDF file, or "builtin:six_axis", an industrial arm of 2.5 m reach that comes with the program. Meshes are looked for beside the file and in its package.
---@param source string
---@return robot
function robot.load(source) end

---What engineers do with scenes: analyses and searches that take a scene and never change it
method = {}

---@class (exact) tendril.method.assembly.options
---@field rods? (string)[] Names; default: all of the scene, which must hang together
---@field connectors? ({name: string, rod: string, at: string?, size: vec?, shape: any?, unit: string?, pose: frame?})[] List of {name =, rod =, at = "start" or "finish", size = or shape =}: rigid bodies at the ends of rods, which collide too
---@field exit? frame|vec|number[] Where the handle must get to; default: anywhere with room (m)
---@field grip? string Rod or branch point to pull it out by; default: chosen
---@field grip_at? number Arc length of the handle on that rod; default: its middle (m; >= 0)
---@field max_strain? number Of the outermost fibre, all the way (> 0; default 0.3)
---@field min_bend_radius? number All the way (m; >= 0; default 0)
---@field deviation? number How near the last state must be to the routed one, in radii of the thickest rod (> 0 and <= 10; default 0.05)
---@field attempts? integer Handles, paths, grips that are tried, at most (1 ... 10000; default 20)
---@field routed? equilibrium An equilibrium of the scene: which one is the routed configuration; default: the one that s:solve finds
---@field optimise? boolean Make what was found shorter, smoother, with more clearance and fewer grips (default true)
---@field optimise_seconds? number For that, at most (s; >= 0; default 5)
---@field replays? integer Of what was proven, by hands that stray by a quarter of the thickest radius: is it fragile? (0 ... 10000; default 0)
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---A manipulation that brings a system of rods to its routed configuration, proven by playing it forward under gravity and in contact.
---@param scene scene
---@param options? tendril.method.assembly.options
---@return assembly
function method.assembly(scene, options) end

---@class (exact) tendril.method.dress_pack.options
---@field path ((number)[])[] Joint values of the via points; straight between them, all pieces take the same time (rad or m)
---@field robot? string Its name in the scene; default: the only one
---@field seconds? number That the path takes: the joints' speeds are kept; default: they are not looked at (s; > 0)
---@field via? integer Via points of the optimised path, first and last among them; default: as many as given (2 ... 200)
---@field clearance? number Of the rods from obstacles and links; default: they may touch (m; >= 0)
---@field robot_clearance? number Of the links from obstacles; default: not looked at (m; >= 0)
---@field steps? integer Time steps of the search (1 ... 100000; default 40)
---@field checked_steps? integer Time steps of the simulations before and after (1 ... 100000; default 200)
---@field optimise? boolean False: the given path is simulated, that is all (default true)
---@field formulation? "reduced"|"direct" Unknowns of the search: "reduced", the via points alone; "direct", all states and stresses as well (default "reduced")
---@field starts? integer Of the search: the given path and others that stray from it (1 ... 10000; default 1)
---@field effort? number Weight of the path's length and unevenness against what the rods bear (>= 0; default 0.02)
---@field weights? (number)[] Of the joints in the path's length; default: all 1
---@field max_tension? number Of the force between a hold and its rod; default: as little as can be (N; > 0)
---@field max_twist? number Against the unstressed rod (rad/m; > 0)
---@field min_bend_radius? number Of the rods (m; > 0)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Simulates the hoses on a robot along a path, and moves its via points so that the hoses bear as little as demanded.
---@param scene scene
---@param options tendril.method.dress_pack.options
---@return dress_pack
function method.dress_pack(scene, options) end

---@class (exact) tendril.method.dress_pack_design.options
---@field adjust table<string, (number)[]> By name {lowest, highest}: "hose.length", "hose.start.x" .y .z (in the link's axes), "hose.start.rx" .ry .rz (turned about the section's own axes), "hose.0.4.at" (a clip's arc length) (m or rad)
---@field motions (((number)[])[])[] The paths that it is adjusted for, each a list of joint values (rad or m)
---@field weights? (number)[] Of the motions; default: all 1
---@field robot? string Its name in the scene; default: the only one
---@field steps? integer Time steps of each motion (1 ... 100000; default 40)
---@field length_weight? number Of the rods' length against what they bear (1/m; >= 0; default 0)
---@field max_tension? number Of the force between a hold and its rod; default: as little as can be (N; > 0)
---@field max_twist? number Against the unstressed rod (rad/m; > 0)
---@field min_bend_radius? number Of the rods (m; > 0)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Adjusts numbers of a dress pack (a hose's length, places and angles of its attachments, a clip's place along it) so that it bears as little as demanded in the motions given. Contact and clearance are not looked at.
---@param scene scene
---@param options tendril.method.dress_pack_design.options
---@return pack_design
function method.dress_pack_design(scene, options) end

---@class (exact) tendril.method.flatten.options
---@field rods? (string)[] Names; default: all of the scene, which must hang together
---@field spacing? number Least distance between axes of rods that do not meet; 0: four times the thickest radius (m; >= 0; default 0)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Gravity and surroundings off: a system of rods relaxed to its own shape, then laid on a plane build board without crossings.
---@param scene scene
---@param options? tendril.method.flatten.options
---@return board
function method.flatten(scene, options) end

---@class (exact) tendril.method.harness.options
---@field connections (frame)[] Two to nine places, each with the direction in which its branch leaves
---@field names? (string)[] Of the connections; default "1", "2" ...
---@field wires? ((integer)[])[] Pairs of connections, counted from 1; default: each one with the first
---@field bundling? number 0: the shortest wires ... 1: the shortest harness (0 ... 1; default 0.5)
---@field section section Cross-section of every branch
---@field min_bend_radius number Of the centre line (m; > 0)
---@field min_straight? number Least straight between two bends (m; >= 0; default 0)
---@field end_straight? number Least straight at both ends of every branch (m; >= 0; default 0)
---@field weights? table<string, number> {length =, clearance =}: what a metre costs, and what it costs more next to obstacles
---@field grid? number Step of the search (m; > 0 and <= 1; default 0.02)
---@field settle? boolean Find its equilibrium under gravity (default true)
---@field refine? boolean Where it settles: adjust lengths, directions at branch points and clips, so that it keeps at rest what its route keeps (default true)
---@field clips? integer That may be used where lengths and directions do not help, over the whole harness (0 ... 1000; default 0)
---@field clip_reach? number From the harness's surface to what it is clipped to, at most (m; >= 0; default 0.05)
---@field max_stretch? number Of a refined branch at rest, as a share of its length: a harness is laid, not strung (> 0 and <= 1; default 0.002)
---@field restarts? integer From routes with bend radius and clearance in reserve, where refinement is not enough (0 ... 20; default 2)
---@field clearance? number Least gap to every obstacle; an obstacle's own larger one stands (m; >= 0; default 0)
---@field free_ends? number Length at both ends within which no gap is asked for: the object must reach what it is plugged to (m; >= 0; default 0)
---@field keep_in? (vec|number[])[] {corner, corner}: the whole object stays within this box (m)
---@field keep_out? ((vec|number[])[])[] List of {corner, corner}: no part of it gets into these boxes (m)
---@field preference? number How much more a metre costs next to obstacles with prefer = "avoid", and away from those with prefer = "near"; 0: the shortest (>= 0; default 0)
---@field preference_range? number Gap from which on a preference counts no more (m; > 0; default 0.1)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---A branched harness between several connections: where it branches, how it runs, and how it settles under gravity.
---@param scene scene
---@param options tendril.method.harness.options
---@return harness
function method.harness(scene, options) end

---@class (exact) tendril.method.preform.options
---@field from frame Where the object begins, and its direction there
---@field to frame Where it ends, and its direction there: on, not back
---@field outer? number Outer diameter; that of the section when one is given (m; > 0)
---@field section? section Cross-section: what the object is made of, for its rod and its equilibrium
---@field min_bend_radius number|(number)[] Of the centre line: one value for every bend, or a list of the bending tools' radii (m)
---@field min_straight? number Least straight between two bends (m; >= 0; default 0)
---@field end_straight? number Least straight at both ends; default: min_straight (m; >= 0)
---@field clearance? number Least gap to every obstacle; an obstacle's own larger one stands (m; >= 0; default 0)
---@field free_ends? number Length at both ends within which no gap is asked for: the object must reach what it is plugged to (m; >= 0; default 0)
---@field keep_in? (vec|number[])[] {corner, corner}: the whole object stays within this box (m)
---@field keep_out? ((vec|number[])[])[] List of {corner, corner}: no part of it gets into these boxes (m)
---@field preference? number How much more a metre costs next to obstacles with prefer = "avoid", and away from those with prefer = "near"; 0: the shortest (>= 0; default 0)
---@field preference_range? number Gap from which on a preference counts no more (m; > 0; default 0.1)
---@field max_bends? integer At most (0 ... 30; default 6)
---@field max_turn? number Largest angle of one bend (rad; > 0 and < 3.141592654; default 3)
---@field min_length? number Least length (m; >= 0; default 0)
---@field max_length? number Largest length (m; > 0)
---@field from_cone? number Half angle of the cone in which the direction of the start may turn (rad; >= 0 and < 1.570796327; default 0)
---@field to_cone? number The same of the finish (rad; >= 0 and < 1.570796327; default 0)
---@field grid? number Step of the search for passages (m; > 0 and <= 1; default 0.02)
---@field exclusion? number Paths of the search keep this far from earlier ones (m; > 0; default 0.06)
---@field max_paths? integer Paths of the search, at most (1 ... 1000; default 30)
---@field max_detour? number Paths of the search cost at most so many times what the cheapest one costs (>= 1; default 6)
---@field same? number Hoses nearer than this all along count as one (m; > 0; default 0.025)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Distinct preformed hoses between two frames, ranked: straights and bends that keep what is demanded, as short as can be.
---@param scene scene
---@param options tendril.method.preform.options
---@return preform_result
function method.preform(scene, options) end

---@class (exact) tendril.method.refine.options
---@field rod rod The design to refine
---@field from frame Where its start is held
---@field to frame Where its finish is held
---@field route? curve Roughly where it runs: the first guess, which decides the passage
---@field min_bend_radius? number Of the centre line in equilibrium (m; >= 0; default 0)
---@field clearance? number Least gap to every obstacle; an obstacle's own larger one stands (m; >= 0; default 0)
---@field free_ends? number Length at both ends within which no gap is asked for (m; >= 0; default 0)
---@field length_weight? number What a metre of the object costs (> 0; default 1)
---@field clearance_weight? number What a metre next to an obstacle costs more (>= 0; default 0)
---@field range? number Gap from which on that counts no more (m; > 0; default 0.1)
---@field min_length? number Least length (m; >= 0)
---@field max_length? number Largest length (m; > 0)
---@field clips? integer That may be added where no adjustment helps, at most (0 ... 50; default 0)
---@field adjust? (string)[] What may be adjusted: "length", "from.turn", "to.turn", "from.tilt", "to.tilt", "clips"; default: the length
---@field solver? "gradient"|"gradient_free" By exact gradients, or without any as in the paper (default "gradient")
---@field max_tension? number In equilibrium (N; > 0)
---@field max_strain? number In equilibrium (> 0)
---@field max_turn? number Of a connection about its tangent, either way (rad; > 0; default 3)
---@field max_tilt? number Of a connection about each axis normal to it, either way (rad; > 0; default 0.25)
---@field clip_reach? number How near an obstacle must be to fasten a clip to it (m; > 0; default 0.05)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Adjusts a design (length, turning of its connections, clips), so that its equilibrium keeps what is demanded at the least cost.
---@param scene scene
---@param options tendril.method.refine.options
---@return refined_design
function method.refine(scene, options) end

---@class (exact) tendril.method.route.options
---@field from frame Where the object begins, and its direction there
---@field to frame Where it ends, and its direction there: on, not back
---@field outer? number Outer diameter; that of the section when one is given (m; > 0)
---@field section? section Cross-section: what the object is made of, for its rod and its equilibrium
---@field min_bend_radius number|(number)[] Of the centre line: one value for every bend, or a list of the bending tools' radii (m)
---@field min_straight? number Least straight between two bends (m; >= 0; default 0)
---@field end_straight? number Least straight at both ends; default: min_straight (m; >= 0)
---@field clearance? number Least gap to every obstacle; an obstacle's own larger one stands (m; >= 0; default 0)
---@field free_ends? number Length at both ends within which no gap is asked for: the object must reach what it is plugged to (m; >= 0; default 0)
---@field keep_in? (vec|number[])[] {corner, corner}: the whole object stays within this box (m)
---@field keep_out? ((vec|number[])[])[] List of {corner, corner}: no part of it gets into these boxes (m)
---@field preference? number How much more a metre costs next to obstacles with prefer = "avoid", and away from those with prefer = "near"; 0: the shortest (>= 0; default 0)
---@field preference_range? number Gap from which on a preference counts no more (m; > 0; default 0.1)
---@field preformed? boolean The route becomes the unstressed shape; else the object is straight without load (default false)
---@field weights? table<string, number>|(table<string, number>)[] {length =, clearance =}: what a metre costs, and what it costs more next to obstacles; a list gives an alternative for each
---@field grid? number Step of the search (m; > 0 and <= 1; default 0.02)
---@field segments? integer Elements of the rod; default by the bend radius (>= 1)
---@field refine? boolean Adjust the design in equilibrium under gravity; else only the nominal route (default true)
---@field restarts? integer From routes with bend radius and clearance in reserve, where refinement fails (0 ... 20; default 3)
---@field clips? integer That may be added where a restart does not help, at most; as few as hold it along its route (0 ... 50; default 0)
---@field min_length? number Least length (m; >= 0; default 0)
---@field max_length? number Largest length (m; > 0)
---@field adjust? (string)[] What may be adjusted: "length", "from.turn", "to.turn", "from.tilt", "to.tilt", "clips"; default: the length
---@field solver? "gradient"|"gradient_free" By exact gradients, or without any as in the paper (default "gradient")
---@field max_tension? number In equilibrium (N; > 0)
---@field max_strain? number In equilibrium (> 0)
---@field max_turn? number Of a connection about its tangent, either way (rad; > 0; default 3)
---@field max_tilt? number Of a connection about each axis normal to it, either way (rad; > 0; default 0.25)
---@field clip_reach? number How near an obstacle must be to fasten a clip to it (m; > 0; default 0.05)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---A flexible object from one frame to another: a reference design of least cost that keeps what is demanded in equilibrium.
---@param scene scene
---@param options tendril.method.route.options
---@return routes
function method.route(scene, options) end

---@class (exact) tendril.method.route_all.options
---@field [integer] table In order; named options beside them are for all of them
---@field from? frame Where the object begins, and its direction there
---@field to? frame Where it ends, and its direction there: on, not back
---@field outer? number Outer diameter; that of the section when one is given (m; > 0)
---@field section? section Cross-section: what the object is made of, for its rod and its equilibrium
---@field min_bend_radius? number|(number)[] Of the centre line: one value for every bend, or a list of the bending tools' radii (m)
---@field min_straight? number Least straight between two bends (m; >= 0; default 0)
---@field end_straight? number Least straight at both ends; default: min_straight (m; >= 0)
---@field clearance? number Least gap to every obstacle; an obstacle's own larger one stands (m; >= 0; default 0)
---@field free_ends? number Length at both ends within which no gap is asked for: the object must reach what it is plugged to (m; >= 0; default 0)
---@field keep_in? (vec|number[])[] {corner, corner}: the whole object stays within this box (m)
---@field keep_out? ((vec|number[])[])[] List of {corner, corner}: no part of it gets into these boxes (m)
---@field preference? number How much more a metre costs next to obstacles with prefer = "avoid", and away from those with prefer = "near"; 0: the shortest (>= 0; default 0)
---@field preference_range? number Gap from which on a preference counts no more (m; > 0; default 0.1)
---@field preformed? boolean The route becomes the unstressed shape; else the object is straight without load (default false)
---@field weights? table<string, number>|(table<string, number>)[] {length =, clearance =}: what a metre costs, and what it costs more next to obstacles; a list gives an alternative for each
---@field grid? number Step of the search (m; > 0 and <= 1; default 0.02)
---@field segments? integer Elements of the rod; default by the bend radius (>= 1)
---@field refine? boolean Adjust the design in equilibrium under gravity; else only the nominal route (default true)
---@field restarts? integer From routes with bend radius and clearance in reserve, where refinement fails (0 ... 20; default 3)
---@field clips? integer That may be added where a restart does not help, at most; as few as hold it along its route (0 ... 50; default 0)
---@field min_length? number Least length (m; >= 0; default 0)
---@field max_length? number Largest length (m; > 0)
---@field adjust? (string)[] What may be adjusted: "length", "from.turn", "to.turn", "from.tilt", "to.tilt", "clips"; default: the length
---@field solver? "gradient"|"gradient_free" By exact gradients, or without any as in the paper (default "gradient")
---@field max_tension? number In equilibrium (N; > 0)
---@field max_strain? number In equilibrium (> 0)
---@field max_turn? number Of a connection about its tangent, either way (rad; > 0; default 3)
---@field max_tilt? number Of a connection about each axis normal to it, either way (rad; > 0; default 0.25)
---@field clip_reach? number How near an obstacle must be to fasten a clip to it (m; > 0; default 0.05)
---@field name? string Of the object, and of its rod in scene()
---@field apart? number Least gap to the objects before it; its clearance where that is more (m; >= 0; default 0)
---@field earlier? "neutral"|"near"|"avoid" How it likes to run beside the objects before it; counts with 'preference' (default "neutral")
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Several flexible objects in order, each an obstacle for those that follow; options of method.route for all or for each.
---@param scene scene
---@param options? tendril.method.route_all.options
---@return routed_objects
function method.route_all(scene, options) end

---@class (exact) tendril.method.stability.options
---@field vary? table<string, number>|(string)[] Design variables: a list of names, or {["hose.length"] = tolerance}; a name that others begin with means all of them; default: lengths, frames of holds and branch points, gravity
---@field measure? (string)[] Names; default: bend radius, tension, length and clearance of every rod
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---The exact first-order matrix: how measures answer to design variables. Print it for a table with units.
---@param scene scene
---@param options? tendril.method.stability.options
---@return stability
function method.stability(scene, options) end

---@class (exact) tendril.method.variation.options
---@field vary table<string, number|{tolerance: number?, relative: boolean?, ball: number?, box: vec?, cone: number?, twist: number?, spread: string|function?, sigma: number?, values: number[]?, frames: frame[]?}> Which numbers vary, by name ("hose.length", "hose.from", "hose.section.EI", "gravity", "tee"), and how
---@field together? ({[integer]: string, correlation: number|number[][]})[] Variables that depend on each other: {{"a.length", "b.length", correlation = 0.8}}
---@field measure? table<integer|string, string|function|{rod: string, what: string, at: number|string?, along: vec?, to: string?}> What is measured on every outcome: names as in eq.measures or "hose.contact_length"; default: bend radius, tension, length and clearance of every rod
---@field outcomes? integer How many (1 ... 100000000; default 1000)
---@field sampling? "random"|"sobol"|"latin" How outcomes fill the space of the variables (default "random")
---@field replicates? integer Of Sobol' points and Latin hypercubes: independent sets, which give the intervals (2 ... 1024; default 8)
---@field effects? integer For so many outcomes each variable is drawn anew: total effects of the contributors (0 ... 10000000; default 0)
---@field store? string File (SQLite) that keeps the outcomes as they come: a study that was stopped goes on there
---@field uniform? boolean Every variable uniform over its tolerance: for envelopes (default false)
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field seed? integer Of all random numbers: the same seed gives the same bits (>= 0; default 1)
---@field threads? integer At most; default: all that the machine has (1 ... 4096)
---@field progress? function function(share, what), called now and then
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Many outcomes of a design whose numbers vary: statistics with confidence intervals, contributors, failures and jumps.
---@param scene scene
---@param options tendril.method.variation.options
---@return variation
function method.variation(scene, options) end

---Pictures
view = {}

---@class (exact) tendril.view.new.options
---@field [integer] scene|equilibrium|motion|preform_result|hose|routes|assembly|board The scene, its equilibrium, or a motion of it (a strip of its states; with an envelope the space swept), hoses of method.preform (all, or one to colour it by its clearance), routes of method.route as they are nominally, an installation by method.assembly, a build board by method.flatten
---@field color? string|(number)[]|stability What the rods' colour says: "clearance", "curvature", "tension", "twist", {r, g, b} from 0 to 1, or a stability: how far tolerances move it; default: clearance when there are obstacles, else curvature
---@field ghost? (string)[] Obstacles to see through, the others are solid; default: all
---@field envelope? mesh A shell around the rods to see through; with color = "clearance" its colours say how near obstacles are to it, and the rods are plain
---@field title? string On the card

---A picture of a scene and its equilibrium; draw it with :save(path).
---@param options? tendril.view.new.options
---@return view
function view.new(options) end

---Charts, motions from files, and what a result costs
study = {}

---@class (exact) tendril.study.motion.options
---@field unit "mm"|"cm"|"m"|"in" Length unit of x, y, z

---A rigid motion from a .csv: columns t (s), x, y, z, and qw, qx, qy, qz or rx, ry, rz (rad) where it turns.
---@param path string
---@param options tendril.study.motion.options
---@return sampled_motion
function study.motion(path, options) end

---@class (exact) tendril.study.chart.options
---@field kind? "lines"|"scatter"|"bars"|"histogram" What it draws (default "lines")
---@field series ({name: string, x: number[], y: number[]})[] List of {name =, x =, y =}
---@field title? string Above it
---@field x_label? string Below it, with the unit: "length [m]"
---@field y_label? string Beside it, with the unit
---@field log_x? boolean Logarithmic (default false)
---@field log_y? boolean Logarithmic (default false)
---@field markers? boolean Mark the points of lines (default true)
---@field direct_labels? boolean Names beside the lines, no legend (default false)
---@field categories? (string)[] Names below the bars
---@field references? ({at: number, across: string?, label: string?})[] Dashed lines: list of {at =, across = "horizontal"|"vertical", label =}
---@field bins? integer Of a histogram; 0: chosen from the data (0 ... 10000; default 0)
---@field size? (integer)[] {width, height}; default {1200, 800} (pixels)

---A chart of lines, points, bars or a histogram; draw it with :save(path).
---@param options tendril.study.chart.options
---@return chart
function study.chart(options) end

---@class (exact) tendril.study.sheet.options
---@field [integer] chart Charts, row by row
---@field title? string Above all of them
---@field columns? integer Charts in a row; 0: as many as rows (0 ... 40; default 0)
---@field size? (integer)[] {width, height} of the whole; default {1600, 1200} (pixels)

---Charts side by side in one picture; draw it with :save(path).
---@param options? tendril.study.sheet.options
---@return sheet
function study.sheet(options) end

---@class (exact) tendril.study.accuracy.options
---@field segments? (integer)[] Numbers of segments of every rod; default {10, 20, 40, 80, 160, 320}
---@field extrapolate? boolean Richardson: each row solves with half its segments too (default false)
---@field exact? function function(s, rod): the exact centre line where it is known, at an arc length in m of the rod with this name; default: a fine solution is the reference
---@field repeat? number For how long each solve is repeated; at least three times (s; 0 ... 3600; default 0.05)
---@field element? "se3"|"staggered" Rod element: fourth order, or the second-order reference element (default "se3")
---@field clamp? "half_cell"|"thesis" How the staggered element clamps an end: second order, or the thesis's first order (default "half_cell")
---@field tolerance? number Largest last step: rotations in rad, positions over the length (1e-14 ... 0.01; default 1e-09)
---@field clearance? "judge"|"push" What obstacles' required clearances do: judged after the solve, or kept: contact then acts that far off, growing from nothing at holds (default "judge")
---@field error? boolean Also estimate the discretisation error (default false)
---@field timeout? number Give up after this time, with the best state so far; default: never (s; > 0 and <= 1000000000)

---Solves a scene with more and more segments: error, order and time of each.
---@param scene scene
---@param options? tendril.study.accuracy.options
---@return accuracy
function study.accuracy(scene, options) end

---The folder of the models that come with the program: engine_bay.ply, engine_bay_light.ply, six_axis.
---@return string
function study.assets() end

---The lines of the interactive shell, to go on as a script
session = {}

---What was typed and ran, without queries of help; empty in a script.
---@return (string)[]
function session.lines() end

---@class (exact) tendril.session.save.options
---@field overwrite? boolean Also a file that is no saved session (default false)

---Writes the session as a script: what failed or asked for help is left out, values that were shown are printed.
---@param path string
---@param options? tendril.session.save.options
---@return saved_file
function session.save(path, options) end

