// Tuned constants of this room. Lengths are in eye distances of the face's frame (FaceFrame: eyes level, y
// down), luma and Cr in 8-bit levels. Evidence is dimensionless: searches weigh it against the squared
// distance from the usual place in units of that place's sigma, so that each "per evidence" below says how
// many levels outweigh one sigma. Where nothing else is said, values were set by eye on the first pictures of
// the ten clips.
#pragma once

#include <array>

namespace fbs::find_tuning {

/// Where evidence is looked for, and the sigma of the usual place.
struct SearchRange {
  double before, after, sigma;
};

// --- Face finder (cascades) ---

constexpr int kSearchRows = 480;  ///< pictures of fewer are enlarged: the cascades' small faces fail
constexpr double kEyeX = 0.19, kEyeY = -0.115;  ///< eyes in the detector's square; median over its faces
constexpr double kMaxEyesOff = 0.25;            ///< both eyes from there, of the square
constexpr double kMinEyesApart = 0.25, kMaxEyesApart = 0.6;  ///< of the square
constexpr double kMaxEyesTilt = 0.36;                        ///< tangent: 20 degrees
constexpr double kEyeRegionWidth = 160;  ///< pixels at least: the eye cascades want eyes of 20
constexpr double kMinDetectorSide = 40;  ///< pixels: twice what the face cascade was trained with

// --- Yaw (estimate_yaw) ---

constexpr double kMaxYawTangent = 0.5, kMaxYawShift = 4.0 / 64;  ///< searched either way
constexpr double kYawStep = 1.0 / 64;
constexpr double kYawSigma = 0.4, kYawShiftSigma = 0.06, kWidthSigma = 0.15;  ///< usual values
/// Weight of each part's evidence. Yaw moves the sides most, and they show it best; set by eye and checked
/// against an independent tracker's yaw on 91 pictures (correlation 0.84).
constexpr double kNoseWeight = 1.5, kMouthWeight = 1, kSideWeight = 4;
constexpr double kSymmetryEvidence = 3;  ///< of halves that are wholly alike
constexpr double kSymmetryGrid = 1.0 / 32, kDetailReach = 0.14;
constexpr double kMinFaceWidth = 0.85, kMaxFaceWidth = 1.2;  ///< of the generic head's

// --- Face border (yaw and sides) ---

constexpr double kBorderLumaReach = 0.06, kBorderRedReach = 0.08;
constexpr double kBorderLumaPerEvidence = 20, kBorderRedPerEvidence = 8;
constexpr double kMaxBorderEvidence = 2;  ///< a dark background is no better evidence than a grey one

// --- Eyes ---

/// The middle of the lids lies this far right of and below the eyes that the cascades give; median over ten
/// faces.
constexpr double kEyeBiasX = 0.04, kEyeBiasY = 0.025;
/// Of the landmarks of both eyes, below their middles: an eye looking at the camera stands wider open than
/// the generic head's, whose lids must close without a fold.
constexpr std::array<double, 12> kLidHeight = {0,     -0.075, -0.075, 0.022, 0.064, 0.064,
                                               0.022, -0.075, -0.075, 0,     0.064, 0.064};

// --- Brows ---

/// iBUG marks the upper border; the dark ridge that is found lies this far below. About kBrowBelowMarks of
/// encoder/track/snake/snake_kinds.h (1.8 / 32).
constexpr double kBrowHalfWidth = 0.056;
constexpr SearchRange kBrowLift = {0.16, 0.14, 0.06};            ///< of a brow as a whole
constexpr SearchRange kBrowPoint = {0.07, 0.07, 0.05};           ///< of each place about that
constexpr double kBrowLiftReach = 0.09, kBrowPointReach = 0.08;  ///< of the valley
constexpr double kMaxBrowValley = 12;  ///< levels; a hat's rim is darker than any brow, and no better for it
constexpr double kBrowLiftPerEvidence = 6, kBrowPointPerEvidence = 8;
constexpr double kBrowBendPrior = 0.05;  ///< weight of the generic brow's curvature, to that of a point's 1

// --- Proportions from person to person: neutral pictures of nine people (mean; standard deviation). They tie
// what is hard to see to what is not. ---

constexpr double kNoseBasePerMouthLine = 0.68;        ///< of its height below the eyes; 0.02
constexpr double kNostrilsPerMouthLine = 0.565;       ///< where the nostrils are darkest
constexpr double kUpperLip = 0.13, kLowerLip = 0.19;  ///< thickness; 0.024, 0.039
constexpr double kChinBelowMouth = 0.65;              ///< 0.085
constexpr double kChinPerOpening = 0.9;               ///< the jaw goes down with the lower lip

// --- Mouth line and nostrils ---

constexpr double kMouthLineFrom = 0.86, kMouthLineTo = 1.45, kMouthLine = 1.11, kMouthLineSigma = 0.12;
constexpr double kLineHalf = 0.22, kLineReach = 0.09;   ///< width of the valley, and its reach
constexpr double kLipsHalf = 0.2;                       ///< width over which redness is compared
constexpr double kRedAbove = 0.06, kRedBelow = 0.08;    ///< lips, from the line
constexpr double kSkinAbove = 0.26, kSkinBelow = 0.34;  ///< skin, from the line
constexpr double kNostrilHalf = 0.18, kNostrilReach = 0.08;
constexpr double kValleyPerEvidence = 8, kRednessPerEvidence = 5;
constexpr double kNoseBaseReach = 0.2, kNoseBaseSigma = 0.04;
constexpr double kLineBelowUpperLip = 0.01;  ///< the line that a mouth would have if it closed

// --- Lip borders on the midline (find_lip_borders) ---

constexpr double kProfileStep = 1.0 / 64, kProfileHalf = 0.10;
constexpr int kProfileSamples = 51, kProfileLine = 21;  ///< from 0.33 above the line to 0.47 below it
constexpr double kProfileLumaSigma = 10, kProfileRedSigma = 2.5;  ///< residual sigmas within skin or a lip
constexpr double kVarianceCost = 0.12;  ///< per squared sigma: samples of a profile are far from independent
constexpr double kUpperLipSigma = 0.05, kLowerLipSigma = 0.075;
constexpr double kOpenCost = 25;  ///< per eye distance: a mouth is closed unless the picture insists
/// Per residual sigma of redness: lips over skin, and what lies between the lips over them.
constexpr double kRednessCost = 2;
constexpr double kMinLipRedness = -12, kMaxLipRedness = 4, kMaxInnerRedness = 12;  ///< beyond, nothing more
/// Samples: thinnest upper lip with margin, skin above, lower lip; largest opening, lower lip.
constexpr int kMinSkinSamples = 2, kMinUpperSamples = 3, kMinLowerSamples = 5, kMinBelowSamples = 4;
constexpr int kMaxOpenSamples = 24, kMaxLowerSamples = 22;

// --- Mouth corners ---

constexpr double kCornerStep = 1.0 / 64;
constexpr double kCornerFrom = 0.1, kCornerTo = 0.56;  ///< from the mouth's middle
constexpr double kCornerStart = 0.26;                  ///< reached at least
constexpr double kCornerMayEnd = 0.28,
                 kCornerEnds = 0.30;   ///< beyond, where the valley falls to such a share
constexpr double kMinStartValley = 4;  ///< levels, of the share's whole
constexpr double kStartMiddle = 0.15, kStartHalf = 0.1, kStartReach = 0.07;
constexpr double kCornerReach = 0.06, kCornerValleyPerEvidence = 4;
constexpr double kFollowReach = 0.02, kFollowMax = 0.10;   ///< of the line's y: from step to step, and in all
constexpr double kUsualCorner = 0.39, kCornerShare = 0.5;  ///< the valley's end says half
constexpr double kMinCorner = 0.30, kMaxCorner = 0.52;
constexpr double kCornerAbove = 0.06, kCornerBelow = 0.08;  ///< of the line

// --- Sides and chin ---

constexpr SearchRange kSide = {0.16, 0.16, 0.07};
constexpr double kCheekInside = 0.5, kCheekY = 0.55;  ///< skin that is surely cheek
constexpr double kInsideReach = 0.10;                 ///< of the border: must look like cheek
constexpr double kInsideLuma = 40, kInsideRed = 10, kMaxInside = 2, kInsideCost = 0.5;
constexpr SearchRange kChin = {0.16, 0.16, 0.07};
constexpr double kChinHalf = 0.2, kChinReach = 0.05, kChinPerEvidence = 14, kMaxChinEvidence = 2;

// --- Adaptation of the generic head to the marks ---

constexpr int kMaxElasticIterations = 80;
/// The Gaussian narrows so that the whole face moves first and details last. The first sigma sets how much of
/// the face goes with a mark, the last how fine a detail a single mark moves.
constexpr double kFirstElasticSigma = 0.55, kLastElasticSigma = 0.035, kElasticDecay = 0.93;
constexpr double kAtRest = 1.0 / 512;   ///< largest force that counts as rest
constexpr double kMinReach = 1.0 / 64;  ///< of an iteration that would fold a triangle, before it is given up
constexpr double kMinArea = 0.05;       ///< of a triangle's own area on the scaled head; less is a fold
constexpr double kMaxMarkedTangent = 0.6;                   ///< of the yaw that marks may show
constexpr double kMarkSigma = 0.06, kMarkedYawSigma = 0.6;  ///< of a mark; of the yaw's tangent before any
constexpr double kMinHeadScale = 0.7, kMaxHeadScale = 1.4;  ///< anatomical limits of width and height
constexpr int kWidthIterations = 5;
constexpr double kMinEyeDistancePx = 4;

}  // namespace fbs::find_tuning
