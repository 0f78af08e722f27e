#!/usr/bin/env python3
"""Numbers for tests/vocabulary/test_definitions.pf: each row of src/vocabulary/ek_definition_rows.f90 that is printed, computed from
directions and points as the program defines it, not from the formula of the row. Writes definition_numbers.txt beside this file.

    python3 tests/vocabulary/definition_numbers.py          (needs mpmath)

A line: program; name; expected value in the unit of the program; variable = value, columns in their units, numbers in SI.
"""
import os
from mpmath import mp, mpf, matrix, sin, cos, tan, asin, atan, atan2, sqrt, pi, diff

mp.dps = 40
DEG = pi/180


def rot(axis, angle):
    c, s = cos(angle), sin(angle)
    return {'x': matrix([[1, 0, 0], [0, c, -s], [0, s, c]]), 'y': matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
            'z': matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])}[axis]


def dot(a, b):
    return sum(a[i]*b[i] for i in range(3))


def cross(a, b):
    return matrix([a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]])


def turned(v, k, angle):
    """v turned about the unit vector k."""
    return v*cos(angle) + cross(k, v)*sin(angle) + k*dot(k, v)*(1 - cos(angle))


class Wheel:
    """A wheel at a state, x forward, y left, z up; left wheel, in m and rad."""

    def __init__(self, rz, rx, ry, rz0, rx0, caster, kingpin):
        self.side, self.rz, self.rx, self.ry = -1, rz, rx, ry
        self.r0 = rot('z', rz0)*rot('x', rx0)
        self.r = rot('z', rz)*rot('x', rx)*rot('y', ry)
        self.carrier = self.r*self.r0.T
        self.arm0 = matrix([mpf('0.004'), mpf('-0.003'), mpf('-0.31')])      # contact point from the wheel centre at design
        self.foot = self.r0.T*self.arm0                                     # in the axes of the wheel; outboard is y
        self.centre = matrix([mpf('1.2'), mpf('0.75'), mpf('0.33')])
        self.moved = matrix([mpf('-0.004'), mpf('0.007'), mpf('0.05')])
        self.now = self.centre + self.moved
        self.arm = self.carrier*self.arm0
        self.patch = self.now + self.arm
        self.w = self.r*matrix([0, 1, 0])                                   # outboard
        self.toe = atan2(self.w[0], self.w[1])                              # front edge inward: the axis points forward
        self.camber = asin(-self.w[2])
        e = self.carrier*matrix([0, 0, 1])
        self.side_view = atan2(-e[0], e[2])                                 # top rearward
        self.k = matrix([-tan(caster), -tan(kingpin), 1])                   # upward, rearward, inward
        self.k = self.k/sqrt(dot(self.k, self.k))
        self.on_axis = self.now + matrix([mpf('0.012'), mpf('-0.06'), mpf('0.02')])
        self.caster, self.kingpin = caster, kingpin

    def axis_at(self, z):
        return self.on_axis + self.k*((z - self.on_axis[2])/self.k[2])


wheel = Wheel(-4*DEG, 3*DEG, mpf('1.5')*DEG, -mpf('0.4')*DEG, mpf('1.2')*DEG, 6*DEG, 11*DEG)
ground, hub = wheel.axis_at(wheel.patch[2]), wheel.axis_at(wheel.now[2])
from_patch, from_centre = ground - wheel.patch, hub - wheel.now
h = sqrt(wheel.w[0]**2 + wheel.w[1]**2)
lateral = matrix([wheel.w[0], wheel.w[1], 0])/h                             # outboard, level
ahead = matrix([wheel.w[1], -wheel.w[0], 0])/h                              # heading of the wheel
MM, M = 1000, 1
columns = {
    'side': -1, 'iso': 1, 'toe_deg': wheel.toe/DEG, 'camber_deg': wheel.camber/DEG, 'steer_deg': -wheel.toe/DEG,
    'caster_deg': wheel.caster/DEG, 'kingpin_inclination_deg': wheel.kingpin/DEG, 'side_view_angle_deg': wheel.side_view/DEG,
    'caster_trail_mm': from_patch[0]*MM, 'scrub_radius_mm': -from_patch[1]*MM,
    'spindle_offset_mm': from_centre[0]*MM, 'spindle_length_mm': -from_centre[1]*MM,
    'height': -wheel.arm[2], 'foot_x': wheel.foot[0], 'foot_y': wheel.foot[1], 'foot_z': wheel.foot[2],
    'design_toe': mpf('0.4')*DEG, 'design_camber': -mpf('1.2')*DEG,
    'centre_x': wheel.now[0], 'centre_y': wheel.now[1], 'centre_z': wheel.now[2],
    'patch_x': wheel.patch[0], 'patch_y': wheel.patch[1], 'patch_z': wheel.patch[2],
    'wheel_centre_x_mm': wheel.moved[0]*MM, 'wheel_centre_y_mm': wheel.moved[1]*MM, 'wheel_centre_z_mm': wheel.moved[2]*MM,
}
lines = []


def row(program, name, expected, names, **more):
    given = dict(columns, **more)
    used = '; '.join('%s = %s' % (n, mp.nstr(mpf(given[n]), 17)) for n in names.split())
    lines.append('%s; %s; %s; %s' % (program, name, mp.nstr(mpf(expected), 17), used))


def same(program, name, column, value, factor=1):
    row(program, name, factor*value, column, **{column: value})


# the camber of design: left wheel, rx0 > 0 is top inward
assert abs(-asin((wheel.r0*matrix([0, 1, 0]))[2]) - columns['design_camber']) < mpf(10)**-30
assert abs(atan2((wheel.r0*matrix([0, 1, 0]))[0], (wheel.r0*matrix([0, 1, 0]))[1]) - columns['design_toe']) < mpf(10)**-30

# Adams/Car: measured on the line of wheel plane and road
same('adams', 'Wheel Travel', 'wheel_travel_mm', mpf('12.5'))
row('adams', 'Toe Angle', columns['toe_deg'], 'toe_deg')
row('adams', 'Steer Angle', columns['steer_deg'], 'steer_deg')
row('adams', 'Camber Angle', -asin(wheel.w[2])/DEG, 'camber_deg')
row('adams', 'Caster Angle', atan(-wheel.k[0]/wheel.k[2])/DEG, 'caster_deg')
same('adams', 'Caster Angle (instant axis)', 'instant_caster_deg', mpf('5.25'))
row('adams', 'Kingpin Inclination Angle', atan(-wheel.k[1]/wheel.k[2])/DEG, 'kingpin_inclination_deg')
row('adams', 'Scrub Radius', -dot(from_patch, lateral)*MM, 'scrub_radius_mm toe_deg caster_trail_mm')
row('adams', 'Caster Moment Arm (Mechanical Trail)', dot(from_patch, ahead)*MM, 'caster_trail_mm toe_deg scrub_radius_mm')
same('adams', 'Wheel Rate', 'wheel_rate_n_per_mm', mpf('22.5'))
same('adams', 'Ride Rate', 'ride_rate_n_per_mm', mpf('20.5'))
row('adams', 'Ride Steer', mpf('-0.004'), 'bump_rotation_z_deg_per_m', bump_rotation_z_deg_per_m=-4)
row('adams', 'Aligning Torque - Steer Compliance', mpf('2e-6'), 'rotational_stiffness_z_nm_per_deg',
    rotational_stiffness_z_nm_per_deg=500)           # 1 N m turns the wheel by 2e-3 deg
same('adams', 'Fore-Aft Wheel Center Stiffness', 'fore_aft_stiffness_n_per_mm', 410)

# MotionView: angles seen along an axis of the car
row('motionview', 'Toe-In (80000010)', atan(wheel.w[0]/wheel.w[1])/DEG, 'toe_deg')
row('motionview', 'Steer Angle', -atan(wheel.w[0]/wheel.w[1])/DEG, 'steer_deg')
row('motionview', 'Camber (80000010)', atan(-wheel.w[2]/wheel.w[1])/DEG, 'camber_deg toe_deg')
row('motionview', 'Caster (80000020)', atan(-wheel.k[0]/wheel.k[2])/DEG, 'caster_deg')
row('motionview', 'Kingpin Inclination (80000020)', atan(-wheel.k[1]/wheel.k[2])/DEG, 'kingpin_inclination_deg')
row('motionview', 'Scrub Radius (80000030)', -from_patch[1]*MM, 'scrub_radius_mm')
row('motionview', 'Caster Trail (80000030)', from_patch[0]*MM, 'caster_trail_mm')
same('motionview', 'Spindle Length (80000270)', 'along_spindle_length_mm', -41, -1)
same('motionview', 'Spindle Offset (80000270)', 'across_spindle_offset_mm', -7, -1)
row('motionview', 'Roll Angle (80000040)', atan(mpf(30)/1480)/DEG,
    'right_wheel_centre_z_mm left_wheel_centre_z_mm right_centre_y left_centre_y', right_wheel_centre_z_mm=10,
    left_wheel_centre_z_mm=-20, right_centre_y=mpf('-0.735'), left_centre_y=mpf('0.745'))
same('motionview', 'Tread Width (80000040)', 'total_track_mm', 1510)
row('motionview', 'Track Width (80000040)', 1480, 'right_centre_y left_centre_y', right_centre_y=mpf('-0.735'),
    left_centre_y=mpf('0.745'))
# a left wheel turns by (0.3, 0.2, -0.5) deg about (forward, left, up) per 0.01 m: top right, top forward, to the right
turn = dict(bump_rotation_x_deg_per_m=30, bump_rotation_y_deg_per_m=20, bump_rotation_z_deg_per_m=-50)
row('motionview', 'Ride Steer (80000180)', -50, 'bump_rotation_z_deg_per_m', **turn)
row('motionview', 'Ride Caster (80000180)', -20, 'iso bump_rotation_y_deg_per_m', **turn)
row('motionview', 'Ride Camber (80000180)', -30, 'side iso bump_rotation_x_deg_per_m', **turn)
same('motionview', 'Parallel Lateral Force Deflection', 'lateral_in_load_held_centre_deflection_mm_per_kn', mpf('0.31'))
row('motionview', 'Converging Lateral Force Deflection', mpf('0.28'), 'side lateral_anti_load_held_centre_deflection_mm_per_kn',
    lateral_anti_load_held_centre_deflection_mm_per_kn=mpf('0.28'))
row('motionview', 'Parallel Aligning Torque Steer (80000100)', mpf('0.2'), 'rotational_stiffness_z_nm_per_deg',
    rotational_stiffness_z_nm_per_deg=500)

# IPGKinematics: Cardan angles; lengths from the contact point that does not spin, in the heading of the wheel
still = rot('z', wheel.rz)*rot('x', wheel.rx)*wheel.foot
still_design = wheel.r0*wheel.foot
heading = matrix([cos(wheel.rz), sin(wheel.rz), 0])
abeam = matrix([-sin(wheel.rz), cos(wheel.rz), 0])
level = wheel.axis_at(wheel.patch[2]) - (wheel.now + still)
for axis in 'xyz':
    row('ipg', axis, wheel.moved['xyz'.index(axis)]*MM, ('iso ' if axis != 'z' else '') + 'wheel_centre_%s_mm' % axis)
row('ipg', 'rx', wheel.rx/DEG, 'side camber_deg')
row('ipg', 'ry', wheel.ry/DEG, 'toe_deg camber_deg side_view_angle_deg design_camber')
row('ipg', 'rz', wheel.rz/DEG, 'side toe_deg')
row('ipg', 'caster', wheel.caster/DEG, 'caster_deg')
row('ipg', 'kingpin inclination', wheel.kingpin/DEG, 'kingpin_inclination_deg')
row('ipg', 'longitudinal hub offset', dot(from_centre, heading)*MM, 'spindle_offset_mm toe_deg spindle_length_mm')
row('ipg', 'lateral hub offset', -dot(from_centre, abeam)*MM, 'spindle_length_mm toe_deg spindle_offset_mm')
row('ipg', 'caster trail', dot(level, heading)*MM,
    'spindle_offset_mm height caster_deg toe_deg spindle_length_mm kingpin_inclination_deg foot_x')
row('ipg', 'scrub radius', -dot(level, abeam)*MM,
    'spindle_length_mm height kingpin_inclination_deg toe_deg spindle_offset_mm caster_deg foot_y camber_deg foot_z')
row('ipg', 'track change', 2*(wheel.moved[1] + still[1] - still_design[1])*MM,
    'side iso wheel_centre_y_mm toe_deg foot_y camber_deg foot_z foot_x design_toe design_camber')
same('ipg', 'wheel load', 'vertical_force_n', 3210)
same('ipg', 'force', '#_force_n', 1810)

# OptimumKinematics: swing arms from the contact point
ic = matrix([mpf('-0.6'), mpf('-0.9'), mpf('0.21')])                        # of the side view (x, z) and of the front view (y, z)
arms = dict(side_view_arm_centre_x_mm=ic[0]*MM, side_view_arm_centre_z_mm=ic[2]*MM, front_view_arm_centre_y_mm=ic[1]*MM,
            front_view_arm_centre_z_mm=ic[2]*MM)
p, c = wheel.patch, wheel.now
car = dict(wheelbase=mpf('2.6'), cg_height=mpf('0.55'), front_brake_share=mpf('0.7'), rear_brake_share=mpf('0.3'),
           front_drive_share=mpf('0.4'), rear_drive_share=mpf('0.6'))
row('optimumk', 'Heave', -12, 'contact_patch_z_mm', contact_patch_z_mm=12)
row('optimumk', 'Toe Angle', -atan(wheel.w[0]/wheel.w[1]*h)/DEG, 'toe_deg camber_deg')
row('optimumk', 'Camber Angle', -asin(wheel.w[2])/DEG, 'camber_deg')
row('optimumk', 'Caster Angle', wheel.caster/DEG, 'caster_deg')
row('optimumk', 'King Pin Angle', wheel.kingpin/DEG, 'kingpin_inclination_deg')
row('optimumk', 'Scrub Radius', -from_patch[1]*MM, 'scrub_radius_mm')
row('optimumk', 'Mechanical Trail', from_patch[0]*MM, 'caster_trail_mm')
row('optimumk', 'Front View Swing Arm Length', sqrt((ic[1] - p[1])**2 + (ic[2] - p[2])**2)*MM,
    'front_view_arm_centre_y_mm patch_y front_view_arm_centre_z_mm patch_z', **arms)
row('optimumk', 'Front View Swing Arm Angle', asin((ic[2] - p[2])/sqrt((ic[1] - p[1])**2 + (ic[2] - p[2])**2))/DEG,
    'front_view_arm_centre_z_mm patch_z front_view_arm_centre_y_mm patch_y', **arms)
row('optimumk', 'Side View Swing Arm Length', sqrt((ic[0] - p[0])**2 + (ic[2] - p[2])**2)*MM,
    'side_view_arm_centre_x_mm patch_x side_view_arm_centre_z_mm patch_z', **arms)
row('optimumk', 'Side View Swing Arm Angle', asin((ic[2] - p[2])/sqrt((ic[0] - p[0])**2 + (ic[2] - p[2])**2))/DEG,
    'side_view_arm_centre_z_mm patch_z side_view_arm_centre_x_mm patch_x', **arms)
same('optimumk', 'Kinematic Roll Center Height', 'roll_centre_height_mm', mpf('28.3'))
row('optimumk', 'Halftrack', abs(p[1])*MM, 'patch_y')
spin = matrix([turn['bump_rotation_%s_deg_per_m' % a]*DEG for a in 'xyz'])
rise = 1 + cross(spin, p - c)[2]                                            # of the contact point per rise of the centre
lever = 'bump_rotation_x_deg_per_m patch_y centre_y bump_rotation_y_deg_per_m patch_x centre_x #_motion_ratio'
row('optimumk', 'Heave Motion Ratio', rise/mpf('0.8'), lever, **dict(turn, **{'#_motion_ratio': mpf('-0.8')}))
# a front wheel ahead of its centre of rotation is pushed down by a braking force: positive
row('optimumk', 'Anti-Dive', 100*car['front_brake_share']*car['wheelbase']/car['cg_height']*(ic[2] - p[2])/(p[0] - ic[0]),
    'wheelbase cg_height iso front_brake_share side_view_arm_centre_z_mm patch_z patch_x side_view_arm_centre_x_mm',
    **dict(arms, **car))
row('optimumk', 'Rear Anti-Lift', 100*car['rear_brake_share']*car['wheelbase']/car['cg_height']*(ic[2] - p[2])/(ic[0] - p[0]),
    'wheelbase cg_height iso rear_brake_share side_view_arm_centre_z_mm patch_z patch_x side_view_arm_centre_x_mm',
    **dict(arms, **car))
row('optimumk', 'Anti-Squat', 100*car['rear_drive_share']*car['wheelbase']/car['cg_height']*(ic[2] - c[2])/(ic[0] - c[0]),
    'wheelbase cg_height iso rear_drive_share side_view_arm_centre_z_mm centre_z side_view_arm_centre_x_mm centre_x',
    **dict(arms, **car))
row('optimumk', 'Front Anti-Lift', 100*car['front_drive_share']*car['wheelbase']/car['cg_height']*(ic[2] - c[2])/(c[0] - ic[0]),
    'wheelbase cg_height iso front_drive_share side_view_arm_centre_z_mm centre_z side_view_arm_centre_x_mm centre_x',
    **dict(arms, **car))

# Lotus
side_axis = matrix([wheel.k[0], 0, wheel.k[2]])/sqrt(wheel.k[0]**2 + wheel.k[2]**2)
row('lotus', 'Bump Travel', 12, 'contact_patch_z_mm', contact_patch_z_mm=12)
row('lotus', 'Camber Angle', -asin(wheel.w[2])/DEG, 'camber_deg')
row('lotus', 'Toe Angle {SAE}', columns['toe_deg'], 'toe_deg')
row('lotus', 'Castor Angle', wheel.caster/DEG, 'caster_deg')
row('lotus', 'Castor Trail (hub)', -from_centre[0]*MM, 'spindle_offset_mm')
row('lotus', 'Castor Offset (grnd)', from_patch[0]*MM, 'caster_trail_mm')
row('lotus', 'Kingpin Angle', wheel.kingpin/DEG, 'kingpin_inclination_deg')
row('lotus', 'Kingpin Offset (w/c)', -from_centre[1]*MM, 'spindle_length_mm')
row('lotus', 'Kingpin Offset (grnd)', -from_patch[1]*MM, 'scrub_radius_mm')
row('lotus', 'Mechanical Trail (grnd)', (from_patch[0]*side_axis[2] - 0*side_axis[0])*MM, 'caster_trail_mm caster_deg')
same('lotus', 'Roll Centre Height', 'roll_centre_height_mm', mpf('293.64'))
row('lotus', 'Ratio', rise/mpf('0.8'), lever, **dict(turn, **{'#_motion_ratio': mpf('-0.8')}))


# MathWorks: camber and toe after a turn about the steering axis, to the left as positive steer of the left wheel is toe-out
def after(angle):
    w = turned(wheel.w, wheel.k, angle)
    return atan2(w[0], w[1]), asin(-w[2])


d_toe, d_camber = diff(lambda a: after(a)[0], 0), diff(lambda a: after(a)[1], 0)
d_sin_toe, d_sin_camber = diff(lambda a: sin(after(a)[0]), 0), diff(lambda a: sin(after(a)[1]), 0)
measured = atan2(-d_sin_camber, d_sin_toe)
if measured > pi/2 or measured < -pi/2:
    measured = atan(-d_sin_camber/d_sin_toe)
steer = dict(steer_camber_deg_per_deg=-d_camber/d_toe)                      # steer of a left wheel is minus its toe
row('mathworks', 'Toe', columns['toe_deg'], 'toe_deg')
row('mathworks', 'Camber', columns['camber_deg'], 'camber_deg')
row('mathworks', 'Caster', measured/DEG, 'side steer_camber_deg_per_deg camber_deg toe_deg', **steer)
row('mathworks', 'Camber Change per Toe Change', d_camber/d_toe, 'side steer_camber_deg_per_deg', **steer)
same('mathworks', 'Bump Steer', 'bump_toe_deg_per_m', mpf('-3.5'))
same('mathworks', 'Bump Camber', 'bump_camber_deg_per_m', mpf('-17.5'))
row('mathworks', 'Caster Trail', ((wheel.now[0] - hub[0]) + tan(measured)*(wheel.now[2] - p[2]))*MM,
    'height side steer_camber_deg_per_deg camber_deg toe_deg spindle_offset_mm', **steer)
row('mathworks', 'Scrub Radius', (abs(wheel.now[1] - hub[1]) - tan(wheel.kingpin)*(wheel.now[2] - p[2]))*MM,
    'spindle_length_mm height kingpin_inclination_deg')
row('mathworks', 'Hub Long Offset', (wheel.now[0] - hub[0])*MM, 'spindle_offset_mm')
row('mathworks', 'Hub Lat Offset', (wheel.now[1] - hub[1])*MM, 'side spindle_length_mm')
same('mathworks', 'Suspension Rate', 'wheel_rate_n_per_mm', mpf('22.5'))
same('mathworks', 'Ride Rate', 'ride_rate_n_per_mm', mpf('20.5'))
row('mathworks', 'Ride Frequency', sqrt(mpf('20.5')/(mpf(1600)/4)), 'ride_rate_n_per_mm car_mass',
    ride_rate_n_per_mm=mpf('20.5'), car_mass=1600)
row('mathworks', 'WC Recession Long', mpf('-0.045'), 'recession_gradient_mm_per_m', recession_gradient_mm_per_m=45)
same('mathworks', 'Spring Ratio', '#_motion_ratio', mpf('-0.8'), -1)

# SAE J670, ISO 8855: offsets in the axes of the tyre, the scrub radius as a distance
row('sae', 'Toe Angle', columns['toe_deg'], 'toe_deg')
row('sae', 'Steer Angle', columns['steer_deg'], 'steer_deg')
row('sae', 'Camber Angle', -asin(wheel.w[2])/DEG, 'camber_deg')
row('sae', 'Inclination Angle', -2, 'side inclination_deg', inclination_deg=2)     # left wheel, top outward: to the left
row('sae', 'Caster Angle', wheel.caster/DEG, 'caster_deg')
row('sae', 'Steering-Axis Inclination Angle', wheel.kingpin/DEG, 'kingpin_inclination_deg')
row('sae', 'Caster Offset at Ground', dot(from_patch, ahead)*MM, 'caster_trail_mm toe_deg scrub_radius_mm')
row('sae', 'Steering-Axis Offset at Ground', -dot(from_patch, lateral)*MM, 'scrub_radius_mm toe_deg caster_trail_mm')
row('sae', 'Scrub Radius', sqrt(dot(from_patch, from_patch))*MM, 'scrub_radius_mm caster_trail_mm')
same('sae', 'Track', 'total_track_mm', 1510)
same('sae', 'Ride Rate', 'ride_rate_n_per_mm', mpf('20.5'))

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), 'definition_numbers.txt'), 'w') as file:
    file.write('# written by definition_numbers.py: program; name; expected; variable = value; ...\n' + '\n'.join(lines) + '\n')
