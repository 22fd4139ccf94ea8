"""Why none of pydicom's test files is a CT volume, file by file.

Each was held against the file's own header (class, modality, samples, frames, places, whether
pydicom decodes it) before it was written down.
"""

REFUSED = {
    "not CT (modality OT)": """
        OT-PAL-8-face.dcm SC_rgb.dcm SC_rgb_16bit.dcm SC_rgb_16bit_2frame.dcm SC_rgb_2frame.dcm
        SC_rgb_32bit.dcm SC_rgb_32bit_2frame.dcm SC_rgb_dcmtk_+eb+cr.dcm
        SC_rgb_dcmtk_+eb+cy+n1.dcm SC_rgb_dcmtk_+eb+cy+n2.dcm SC_rgb_dcmtk_+eb+cy+np.dcm
        SC_rgb_dcmtk_+eb+cy+s2.dcm SC_rgb_dcmtk_+eb+cy+s4.dcm SC_rgb_dcmtk_ebcr_dcmd.dcm
        SC_rgb_dcmtk_ebcyn1_dcmd.dcm SC_rgb_dcmtk_ebcyn2_dcmd.dcm SC_rgb_dcmtk_ebcynp_dcmd.dcm
        SC_rgb_dcmtk_ebcys2_dcmd.dcm SC_rgb_dcmtk_ebcys4_dcmd.dcm SC_rgb_expb.dcm
        SC_rgb_expb_16bit.dcm SC_rgb_expb_16bit_2frame.dcm SC_rgb_expb_2frame.dcm
        SC_rgb_expb_32bit.dcm SC_rgb_expb_32bit_2frame.dcm SC_rgb_gdcm2k_uncompressed.dcm
        SC_rgb_gdcm_KY.dcm SC_rgb_jpeg.dcm SC_rgb_jpeg_dcmd.dcm SC_rgb_jpeg_dcmtk.dcm
        SC_rgb_jpeg_gdcm.dcm SC_rgb_jpeg_lossy_gdcm.dcm SC_rgb_rle.dcm SC_rgb_rle_16bit.dcm
        SC_rgb_rle_16bit_2frame.dcm SC_rgb_rle_2frame.dcm SC_rgb_rle_32bit.dcm
        SC_rgb_rle_32bit_2frame.dcm SC_rgb_small_odd.dcm SC_rgb_small_odd_big_endian.dcm
        SC_rgb_small_odd_jpeg.dcm SC_ybr_full_422_uncompressed.dcm SC_ybr_full_uncompressed.dcm
        image_dfl.dcm mlut_18.dcm vlut_04.dcm
    """,
    "a single slice": """
        693_J2KI.dcm 693_J2KR.dcm 693_UNCI.dcm 693_UNCR.dcm CT_small.dcm
        J2K_pixelrep_mismatch.dcm MR-SIEMENS-DICOM-WithOverlays.dcm MR2_J2KI.dcm MR2_J2KR.dcm
        MR2_UNCI.dcm MR2_UNCR.dcm MR_small.dcm MR_small_RLE.dcm MR_small_bigendian.dcm
        MR_small_expb.dcm MR_small_implicit.dcm MR_small_jp2klossless.dcm
        MR_small_jpeg_ls_lossless.dcm MR_small_padded.dcm bad_sequence.dcm examples_overlay.dcm
        explicit_VR-UN.dcm
    """,
    "not CT (modality US)": """
        ExplVR_BigEnd.dcm JPGLosslessP14SV1_1s_1f_8b.dcm OBXXXX1A.dcm OBXXXX1A_2frame.dcm
        OBXXXX1A_expb.dcm OBXXXX1A_expb_2frame.dcm OBXXXX1A_rle.dcm OBXXXX1A_rle_2frame.dcm
        US1_J2KI.dcm US1_J2KR.dcm US1_UNCI.dcm US1_UNCR.dcm color-pl.dcm color-px.dcm
        color3d_jpeg_baseline.dcm examples_jpeg2k.dcm examples_palette.dcm
        examples_rgb_color.dcm examples_ybr_color.dcm gdcm-US-ALOKA-16.dcm
        gdcm-US-ALOKA-16_big.dcm
    """,
    "DICOM, but truncated or of no series (no SeriesInstanceUID)": """
        JPEGLSNearLossless_08.dcm JPEGLSNearLossless_16.dcm SC_rgb_jls_lossy_line.dcm
        SC_rgb_jls_lossy_sample.dcm UN_sequence.dcm empty_charset_LEI.dcm
        meta_missing_tsyntax.dcm nested_priv_SQ.dcm no_meta_group_length.dcm priv_SQ.dcm
    """,
    "not CT (modality CR)": """
        RG1_J2KI.dcm RG1_J2KR.dcm RG1_UNCI.dcm RG1_UNCR.dcm RG3_J2KI.dcm RG3_J2KR.dcm
        RG3_UNCI.dcm RG3_UNCR.dcm
    """,
    "not a DICOM file": """
        README.txt crayons.icc no_meta.dcm rtplan.dump rtstruct.dump test1.json test_PN.json
        zipMR.gz
    """,
    "not CT (modality RTDOSE)": """
        badVR.dcm rtdose.dcm rtdose_1frame.dcm rtdose_expb.dcm rtdose_expb_1frame.dcm
        rtdose_rle.dcm rtdose_rle_1frame.dcm
    """,
    "not CT (modality NM)": """
        JPEG-LL.dcm JPEG-lossy.dcm JPEG2000-embedded-sequence-delimiter.dcm JPEG2000.dcm
        JPEG2000_UNC.dcm JPGExtended.dcm
    """,
    "damaged file (NumberOfFrames is 10, and 0 frames are described)": """
        emri_small.dcm emri_small_RLE.dcm emri_small_big_endian.dcm
        emri_small_jpeg_2k_lossless.dcm emri_small_jpeg_ls_lossless.dcm
    """,
    "not CT (modality RTPLAN)": """
        ExplVR_BigEndNoMeta.dcm ExplVR_LitEndNoMeta.dcm rtplan.dcm rtplan_truncated.dcm
    """,
    "not CT (modality SEG)": """
        liver.dcm liver_1frame.dcm liver_expb.dcm liver_expb_1frame.dcm
    """,
    "not CT (modality none given)": """
        GDCMJ2K_TextGBR.dcm SC_jpeg_no_color_transform.dcm SC_jpeg_no_color_transform_2.dcm
        SC_rgb_jpeg_app14_dcmd.dcm
    """,
    "not CT (modality SR)": """
        reportsi.dcm reportsi_with_empty_number_tags.dcm test-SR.dcm
    """,
    "is truncated": """
        MR_truncated.dcm emri_small_jpeg_2k_lossless_too_short.dcm
    """,
    "not CT (modality ECG)": """
        waveform_ecg.dcm
    """,
    "not CT (modality RTSTRUCT)": """
        rtstruct.dcm
    """,
    "perfusion map (RCBF, ml/100ml/s), no Hounsfield units": """
        eCT_Supplemental.dcm
    """,
}
"""Beginning of the reason -> names of the files."""
